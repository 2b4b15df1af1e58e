"""One page on a link: `facts` from the cube, `picture` of its transfer stiffness, `page`."""
