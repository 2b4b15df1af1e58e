"""`python -m foilstudy` is the command `foilstudy`."""

from foilstudy.command import main

if __name__ == "__main__":
    main()
