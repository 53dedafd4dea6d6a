"""``python -m planformer.cli``: the command line."""

from planformer.cli.app import main

main()
