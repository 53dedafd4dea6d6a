"""The command line, `planformer`; one command a module."""
