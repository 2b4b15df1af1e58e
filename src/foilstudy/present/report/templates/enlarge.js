// A click or tap on a figure shows it as large as the window, or larger; another one closes it.
"use strict";
(function () {
  const large = document.createElement("dialog");
  large.className = "large";
  const picture = large.appendChild(document.createElement("img"));
  large.addEventListener("click", () => large.close());
  document.body.appendChild(large);
  for (const button of document.querySelectorAll("button.enlarge")) {
    const image = button.querySelector("img");
    button.addEventListener("click", () => {
      picture.src = image.src;
      picture.alt = image.alt;
      // on a screen narrower than the figure it keeps a size at which it can be read
      picture.className = image.naturalWidth > window.innerWidth ? "wide" : "";
      large.showModal();
    });
  }
})();
