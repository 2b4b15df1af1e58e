# make study | test | lint: the environment .venv is made, or brought up to date, on the way.

PYTHON ?= python3
CORES ?= 2
BIN := .venv/bin
RUNTIME := .venv/.runtime-installed
DEVELOPMENT := .venv/.development-installed
PIP := $(BIN)/python -m pip --disable-pip-version-check --quiet
LOCK := $(BIN)/uv pip compile --quiet --universal --python-version 3.11 --generate-hashes \
	--no-header --no-emit-index-url --no-emit-find-links

.DEFAULT_GOAL := help
.PHONY: help study test test-slow lint format lock clean
.DELETE_ON_ERROR:

help:
	@echo "make study      small but real study on $(CORES) cores -> results/<study.name>/report.html"
	@echo "                (CONFIG=config/thesis.yaml for another one, CORES=8 for more jobs at once)"
	@echo "make test       tests; make test-slow adds those that run whole studies"
	@echo "make lint       ruff on the package, the workflow scripts and the tests"
	@echo "make format     ruff's formatter and its safe fixes"
	@echo "make lock       pin the newest compatible requirements"
	@echo "make clean      remove .venv and caches, keep results"

study: $(RUNTIME)
	@$(BIN)/snakemake -j$(CORES) $(if $(CONFIG),--configfile $(CONFIG))

# Kernels first, so that no two test processes compile the same one; a file stays in one process.
test: $(DEVELOPMENT)
	@$(BIN)/python -c "from foilstudy.study.sweep.warmup import compile_kernels; compile_kernels()"
	@$(BIN)/python -m pytest -n $(CORES) --dist loadfile

test-slow: $(DEVELOPMENT)
	@$(BIN)/python -m pytest -m "slow or not slow"

lint: $(DEVELOPMENT)
	@$(BIN)/ruff check src tests workflow/scripts benchmarks docs

format: $(DEVELOPMENT)
	@$(BIN)/ruff format src tests workflow/scripts benchmarks docs/*.py docs/page_blocks
	@$(BIN)/ruff check --fix src tests workflow/scripts benchmarks docs

lock: $(DEVELOPMENT)
	@$(LOCK) --upgrade requirements/requirements.in -o requirements/requirements.txt
	@$(LOCK) --upgrade requirements/dev.in -o requirements/dev.txt
	@$(LOCK) --upgrade requirements/slurm.in -o requirements/slurm.txt

clean:
	@rm -rf .venv .snakemake .pytest_cache .ruff_cache .hypothesis build src/*.egg-info
	@find src tests workflow -name __pycache__ -type d -prune -exec rm -rf {} +

$(RUNTIME): requirements/requirements.txt pyproject.toml
	@$(PYTHON) -c "import sys; sys.exit(sys.version_info < (3, 11))" || { \
		echo "foilstudy needs Python 3.11 or newer, but '$(PYTHON)' is $$($(PYTHON) --version 2>&1); \
	install one and name it: make PYTHON=python3.12 $(MAKECMDGOALS)" >&2; exit 1; }
	@echo "Installing the pinned requirements into .venv (a few minutes the first time)"
	@$(PYTHON) -m venv .venv
	@$(PIP) install --require-hashes -r requirements/requirements.txt
	@$(PIP) install --no-deps --no-build-isolation --editable .
	@touch $@

$(DEVELOPMENT): $(RUNTIME) requirements/dev.txt
	@$(PIP) install --require-hashes -r requirements/dev.txt
	@touch $@
