# Everything from a bare Debian machine on: `make demo` and `make test` install what they miss, system packages with
# apt (as root or through sudo), the rest into .venv. `make help` lists the targets.

PYTHON ?= python3
VENV := .venv
BIN := $(VENV)/bin
INSTALLED := $(VENV)/.installed
SCRIPT_TOOLS := node_modules/.installed
CHECK := build/check-wheel
LIVE := build/live

.NOTPARALLEL:
.DELETE_ON_ERROR:
.DEFAULT_GOAL := help

.PHONY: demo
demo: $(INSTALLED) ## build the demo site in demo-site/
	$(BIN)/shapeviz-report demo -o demo-site

.PHONY: test
test: style drawing-library browsers ## run every check and every test
	@# Three processes on two cores: tests of builds and browsers wait for a third of their time.
	$(BIN)/pytest --numprocesses 3 --dist loadfile --no-loadscope-reorder --durations 25

.PHONY: check
check: style drawing-library ## the quick part of it: style, imports, types, scripts, and the unit and contract tests that are not slow
	$(BIN)/pytest --numprocesses 2 --dist loadfile --durations 5 -m 'not slow' tests/unit tests/contract

.PHONY: format
format: $(INSTALLED) $(SCRIPT_TOOLS) ## put files in form
	$(BIN)/ruff format .
	PATH="$(CURDIR)/$(BIN):$$PATH" npm run --silent format

.PHONY: chunks
chunks: $(INSTALLED) ## tell the scripts the types of the site's data, after a change of pages/chunks.py
	$(BIN)/python tests/chunk_types.py

.PHONY: style
style: $(INSTALLED) $(SCRIPT_TOOLS)
	$(BIN)/ruff check .
	$(BIN)/ruff format --check .
	$(BIN)/lint-imports
	printf '%s\n' linux darwin win32 | xargs -P 3 -I SYSTEM $(BIN)/mypy --platform SYSTEM --cache-dir .mypy_cache/SYSTEM
	PATH="$(CURDIR)/$(BIN):$$PATH" npm run --silent check

.PHONY: docs
docs: $(INSTALLED) browser $(LIVE)/.made ## build the documentation in build/docs, with the demo site in it
	rm -rf build/docs
	$(BIN)/sphinx-build -q -E -W --keep-going -d build/doctrees docs build/docs
	$(BIN)/python docs/links.py build/docs
	@echo "The documentation is ready. Open $(CURDIR)/build/docs/index.html"

# The demo's sites, which the documentation shows.
$(LIVE)/.made: $(INSTALLED) $(shell find shapeviz_report site templates -type f -not -path '*/__pycache__/*')
	$(BIN)/shapeviz-report demo -o $(LIVE)/demo
	$(BIN)/shapeviz-report demo -o $(LIVE)/report.html --single-file
	@touch $@

.PHONY: wheel
wheel: $(INSTALLED) ## build the wheel and the source distribution in dist/
	$(BIN)/hatchling build

.PHONY: check-wheel
check-wheel: $(INSTALLED) ## install the wheel on its own and compare its site with the checkout's
	rm -rf $(CHECK)
	$(BIN)/hatchling build -t wheel -d $(CHECK)
	$(PYTHON) -m venv $(CHECK)/venv
	$(CHECK)/venv/bin/pip install --quiet --constraint constraints.txt $(CHECK)/*.whl
	$(BIN)/python -c 'from shapeviz_report.demo import write_shape; \
	  [write_shape("$(CHECK)/shapes", name, index) for name in ("cup", "table") for index in range(3)]'
	$(BIN)/shapeviz-report build $(CHECK)/shapes -o $(CHECK)/from-checkout --cache $(CHECK)/cache-checkout
	$(CHECK)/venv/bin/shapeviz-report build $(CHECK)/shapes -o $(CHECK)/from-wheel --cache $(CHECK)/cache-wheel
	# about.html and summary.json say how long the build took; all else is the same to the byte.
	diff -r --exclude=about.html --exclude=summary.json $(CHECK)/from-checkout $(CHECK)/from-wheel
	@echo "The wheel's site is the checkout's."

.PHONY: clean
clean: ## remove what make has made, and what the tools keep
	rm -rf $(VENV) node_modules build dist demo-site .hypothesis .pytest_cache .ruff_cache .mypy_cache .import_linter_cache
	find shapeviz_report tests benchmarks -name __pycache__ -prune -exec rm -rf {} +

.PHONY: help
help: ## list the targets
	@awk -F ':.*## ' '/^[a-z-]+:.*## / { printf "  make %-12s %s\n", $$1, $$2 }' $(MAKEFILE_LIST)

$(INSTALLED): pyproject.toml constraints.txt
	@$(PYTHON) -c 'import sys; sys.exit(sys.version_info < (3, 11))' || { \
	  echo "Python 3.11 or newer is needed. Name one: make PYTHON=python3.12" >&2; exit 1; }
	@$(PYTHON) -c 'import ensurepip' 2>/dev/null || \
	  $(call apt_install,$$($(PYTHON) -c 'import sys; print("python%d.%d-venv" % sys.version_info[:2])'))
	$(PYTHON) -m venv $(VENV)
	$(BIN)/pip install --quiet --constraint constraints.txt --editable '.[docs,test]'
	@# UMAP's neighbour search compiles on its first import; what it compiles stays in the environment.
	@$(BIN)/python -W ignore -c 'import umap'
	@touch $@

# Node comes from the Python package index like everything else; nothing of it takes part in a build.
$(SCRIPT_TOOLS): package.json $(INSTALLED)
	PATH="$(CURDIR)/$(BIN):$$PATH" npm install --no-package-lock --no-audit --no-fund --silent
	@touch $@

.PHONY: drawing-library
drawing-library:
	@PATH="$$PATH:/sbin:/usr/sbin" ldconfig -p | grep -q 'libOSMesa\.so' || $(call apt_install,libosmesa6)

# For tests Chromium, Firefox and WebKit, what drives them, and a screen in memory that they are drawn on; for pictures in
# the documentation one of them.
.PHONY: browsers browser
browsers browser: $(INSTALLED)
	@missing=$$($(BIN)/python tests/browsers.py $(if $(filter browser,$@),chromium-headless-shell)); \
	  [ -z "$$missing" ] || $(call apt_install,$$missing)

# Install Debian packages. As a user without sudo, say what to ask for.
define apt_install
{ \
  sudo=env; [ "$$(id -u)" = 0 ] || sudo=sudo; \
  command -v apt-get >/dev/null && command -v $$sudo >/dev/null || \
    { echo "Please have this installed: $(1)" >&2; exit 1; }; \
  $$sudo apt-get update -q && \
  $$sudo env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $(1); \
}
endef
