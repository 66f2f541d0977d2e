# `make help` lists the targets; each one installs its own Debian packages first, builds what it
# needs and recomputes nothing that is up to date. CMake and Ninja know how programs are made; this file knows
# the way from programs to data, figures and verdicts.

PRESET ?= release
PREFIX ?= /usr/local
FUZZ_SECONDS ?= 60
SITE   ?= build/site
BUILD  := build/$(PRESET)
BIN    := $(BUILD)/bin
# A path that the user gives, blanks and all, for the shell, which still reads ~.
path    = $(subst $() $(),\ ,$(1))

.DEFAULT_GOAL := help
.DELETE_ON_ERROR:
.SUFFIXES:
MAKEFLAGS += --no-builtin-rules
# As many experiments at a time as there are processors, unless the command line says otherwise.
MAKEFLAGS += -j$(shell nproc)
SHELL := /bin/sh
# Decimal points and UTF-8 whatever the user's language.
export LC_ALL := C.UTF-8
# Dates inside PDF files are the commit's: the same data make the same file.
export SOURCE_DATE_EPOCH := $(shell git log -1 --format=%ct 2>/dev/null || echo 0)

# ---- what there is -------------------------------------------------------------------------------------------
# CMake writes down what the calls of experiment() declare (experiments/CMakeLists.txt): the names of all experiments;
# `timed`, whose seconds are compared; `slow`; `drawn`, with script_of_<name>; with_<mode>, those that know a longer run. Goals
# that need no experiment do without it. To make it, packages have to be there.
without_list := help deps deps-peers deps-paper deps-docs deps-site deps-python deps-compare deps-instructions deps-fuzz deps-format deps-mutants \
                programs build check python python-door hostile instructions mutants fuzz levels docs site gallery install format clean
ifneq ($(filter-out $(without_list),$(or $(MAKECMDGOALS),help)),)
include $(BUILD)/experiments.mk
endif

# Timed experiments come first: nothing else of ours runs beside them. Then the slow ones.
DATA        := $(patsubst %,build/data/%.tsv,$(timed) $(slow) $(filter-out $(timed) $(slow),$(experiments)))
FIGURES     := $(foreach f,$(drawn),build/figures/$f.pdf build/figures/$f.png)
PUBLISHED   := $(wildcard paper/published/*.tsv)

.PHONY: help deps deps-peers deps-paper deps-docs deps-site deps-python deps-compare deps-instructions deps-fuzz deps-format deps-mutants programs build data figures scorecard verdicts \
        check python python-door hostile instructions mutants fuzz levels paper docs site install long work-precision arena extremes gallery format clean

help: ## This list
	@sed -n 's/^\([a-z-]*\):.*## \(.*\)/\1	\2/p' $(MAKEFILE_LIST) | while IFS='	' read -r target text; do \
	  printf '  make %-15s %s\n' "$$target" "$$text"; done
	@printf '\nVariables: PRESET=%s (release, portable, sanitize, debug), PREFIX=%s; -jN runs N experiments side by side.\n' \
	  '$(PRESET)' '$(PREFIX)'

# ---- packages: a no-op without network or rights when all are there --------------------------------------------
base_packages  := git g++ cmake ninja-build libeigen3-dev libgsl-dev libcli11-dev libfmt-dev libgtest-dev liblbfgs-dev gnuplot-nox
peers_packages := libboost-dev libsundials-dev libopenmpi-dev openmpi-bin
paper_packages := latexmk texlive-latex-recommended texlive-latex-extra texlive-science texlive-fonts-recommended \
                  texlive-bibtex-extra lmodern
docs_packages  := doxygen doxygen-awesome-css libjs-katex python3
site_packages  := chromium
python_packages := python3-dev pybind11-dev python3-pybind11 python3-numpy
compare_packages := python3-scipy python3-matplotlib
# Others break lines elsewhere. The test of the format (tests/CMakeLists.txt) reads this line.
clang_format := clang-format-14

# $(call install,packages): root installs, another user asks sudo where it can answer, else one line says what to run.
# One at a time: apt's lock on its lists is not waited for.
define install
@exec 9<$(firstword $(MAKEFILE_LIST)) && flock 9; command -v dpkg-query >/dev/null || { \
  echo "No dpkg here; taking for granted what these Debian packages hold: $(1)"; exit 0; }; \
missing=; for package in $(1); do \
  [ "$$(dpkg-query -W -f '$${db:Status-Status}' $$package 2>/dev/null)" = installed ] || missing="$$missing $$package"; \
done; \
[ -n "$$missing" ] || exit 0; \
get="apt-get install -y -o DPkg::Lock::Timeout=600 --no-install-recommends$$missing"; \
if [ "$$(id -u)" = 0 ]; then become=; \
elif command -v sudo >/dev/null && { sudo -n true 2>/dev/null || [ -t 0 ]; }; then become=sudo; \
else echo "Packages are missing; as root, run:  apt-get update && $$get" >&2; exit 1; fi; \
echo "Installing$$missing"; \
$$become env DEBIAN_FRONTEND=noninteractive sh -c "apt-get -qq update && $$get"
endef

deps: ## Install what `figures` and `check` need
	$(call install,$(base_packages))
deps-peers: deps ## Install the peer integrators that work_precision can measure
	$(call install,$(peers_packages))
deps-paper: deps ## Install TeX
	$(call install,$(paper_packages))
deps-docs: deps ## Install Doxygen
	$(call install,$(docs_packages))
deps-site: deps-docs
	$(call install,$(site_packages))
deps-python: deps ## Install what the Python module needs
	$(call install,$(python_packages))
deps-compare: deps-python ## Install SciPy and matplotlib, for the module's examples, plots and comparisons
	$(call install,$(compare_packages))
deps-instructions: deps
	$(call install,valgrind)
deps-mutants: deps
	$(call install,python3)
deps-fuzz: deps
	$(call install,clang-14 libclang-rt-14-dev)
deps-format:
	$(call install,$(clang_format))

# ---- programs --------------------------------------------------------------------------------------------------
configure = cmake --preset $(PRESET) >/dev/null
compile   = cmake --build $(BUILD) --target

# Peers and pybind11 are found when CMake configures, so they have to be there by then.
programs: deps $(if $(filter work-precision paper,$(MAKECMDGOALS)),deps-peers) $(if $(filter check,$(MAKECMDGOALS)),deps-python)
	@$(configure) && $(compile) experiments
# Goals that need the list have it made before anything else.
$(BUILD)/experiments.mk: CMakeLists.txt CMakePresets.json $(shell find experiments -name CMakeLists.txt) | deps
	@$(configure)
build: programs | build/data ## Build everything: experiments, tests and checks
	@$(call alone,all) $(compile) all
# Made by `programs`; the empty command has make look at the file again, so only a relinked program reruns.
$(patsubst %,$(BIN)/%,$(experiments) scorecard): programs
	@:

check: build ## Build and run every test
	flock --exclusive build/data/.alone ctest --test-dir $(BUILD) --output-on-failure --parallel $(shell nproc)
python: deps-compare ## Build the Python module: build/python, for PYTHONPATH
	@$(configure) -DAVI_PYTHON=ON && $(compile) _avi && cmake --install $(BUILD) --component python --prefix build/python >/dev/null \
	  && echo "PYTHONPATH=$(CURDIR)/build/python"
python-door: build/data/python_door.tsv ## Measure what the Python module costs beside C++ and SciPy
build/data/python_door.tsv: lib/python/measure/python_door.py $(wildcard lib/python/avi/*.py lib/python/src/*) | python build/data
	@$(compile) same_digits && flock --exclusive build/data/.alone env PYTHONPATH=build/python OMP_NUM_THREADS=1 /usr/bin/python3 $< \
	  --program $(BIN)/same_digits --output build/data
hostile: programs ## Does avi::solve() keep its promise? SYSTEMS=1000 systems drawn at random by SEED=1, at five tolerances: an hour
	@$(compile) hostile && mkdir -p build/extremes && $(BIN)/hostile --systems $(or $(SYSTEMS),1000) --seed $(or $(SEED),1) \
	  --output build/extremes/hostile.tsv
instructions: deps-instructions ## Count the instructions of fixed work, warn where they grew by over 10 % (ACCEPT=1 takes the counts over)
	@cmake --preset portable >/dev/null && cmake --build build/portable --target instructions_workload
	@tests/instructions/compare.sh build/portable/bin/instructions_workload tests/instructions/counts.tsv $(if $(ACCEPT),accept)
mutants: deps-mutants ## Do the tests notice a wrong token? N=60 random ones of lib/, drawn by SEED=1 (half an hour on two quiet processors)
	@python3 tests/mutants.py -n $(or $(N),60) --seed $(or $(SEED),1)
fuzz: deps-fuzz ## Search for bad input with libFuzzer, FUZZ_SECONDS (60) for each target
	@cmake --preset fuzz >/dev/null && cmake --build build/fuzz --target fuzzers
	@for each in table options step door; do mkdir -p build/fuzz/corpus/$$each; echo "fuzzing $$each"; \
	  build/fuzz/bin/$${each}_fuzz -max_total_time=$(FUZZ_SECONDS) -close_fd_mask=3 -print_final_stats=1 \
	  -artifact_prefix=build/fuzz/$$each- build/fuzz/corpus/$$each tests/fuzz/corpus/$$each || exit 1; done
levels: deps-fuzz ## Compare the numbers of g++ and clang++ at -O0, -O2 and -O3, native and portable
	@tests/levels.sh $(LEVELS)
install: ## Install the library under PREFIX: needs a compiler, CMake and Eigen (CMAKE_ARGS=-DBUILD_SHARED_LIBS=ON: the shared one)
	@cmake -S . -B build/install $(CMAKE_ARGS) >/dev/null
	+@cmake --build build/install
	cmake --install build/install --prefix $(call path,$(PREFIX))

# ---- data ------------------------------------------------------------------------------------------------------
# A shared lock is held by every experiment and by who builds all, an exclusive one by the timed and by the tests: they run alone,
# whatever -j and `make figures check` say.
alone = flock $(if $(filter $(timed),$(1)),--exclusive,--shared) build/data/.alone

# `make paper` alone takes the timed data that are there: a machine that is busy now must not change what was measured
# before. Only what lacks the libraries to compare with, as after `make figures` alone, is measured, as a whole.
lacking := $(shell grep -l 'peers:.*absent' $(patsubst %,build/data/%.tsv,work_precision front_door) 2>/dev/null)
held := $(if $(filter-out paper,$(MAKECMDGOALS)),,$(filter-out $(lacking),$(wildcard $(patsubst %,build/data/%.tsv,$(timed)))))

data: $(DATA) build/data/manifest.tsv ## Run every experiment: build/data/<stem>.tsv
$(filter-out $(held),$(DATA)): build/data/%.tsv: $(BIN)/% | build/data
	@echo "running $*"; $(call alone,$*) $(BIN)/$* --output build/data && test -s $@ \
	  && experiments/common/fresh_data.sh --note $(BIN)/$* build/data

build/data/manifest.tsv: experiments/common/manifest.sh $(DATA)
	@experiments/common/manifest.sh build/data >$@.part && mv $@.part $@

build/scorecard.txt: $(BIN)/scorecard $(DATA) $(PUBLISHED) | build/data
	@$(BIN)/scorecard --published paper/published --data build/data --output build/data >$@.part \
	  || { cat $@.part; exit 1; }; mv $@.part $@
scorecard: build/scorecard.txt ## Compare every published number and claim with ours
	@cat $<
	@cmp -s build/data/scorecard_verdicts.tsv paper/verdicts.tsv || \
	  echo "Some verdicts are not those of paper/verdicts.tsv, which lib/docs/reproduction.md states: make verdicts takes these over."
verdicts: build/scorecard.txt ## Take over today's verdicts, and today's numbers into README and the guide, as the tests compare them
	@cp build/data/scorecard_verdicts.tsv paper/verdicts.tsv
	@$(compile) page_numbers >/dev/null && $(BIN)/page_numbers

# ---- figures ---------------------------------------------------------------------------------------------------
# $(call draw_both,stem,data folder,output without extension): PDF and PNG from one start, in which fonts are looked up once.
# gnuplot does not notice a disk that fills up, so the ends of both are looked at.
draw_both = gnuplot $(foreach t,pdf png,-e "data='$(2)'; output='$(3).part.$t'; terminal='$t'" $(script_of_$(1)) -e "reset session") \
  && { tail -c 8 $(3).part.pdf | grep -aq EOF && tail -c 8 $(3).part.png | grep -aq IEND || { echo "Figure $(1) is cut off: no space left?" >&2; false; }; } \
  && mv $(3).part.pdf $(3).pdf && mv $(3).part.png $(3).png

figures: $(DATA) build/data/manifest.tsv $(FIGURES) scorecard ## Build, run, draw every figure, print the scorecard (the main job)
# A figure depends on its script and on what else its chapter's folder holds for several scripts.
define figure_rule
build/figures/$(1).pdf build/figures/$(1).png &: $(2) figures/style.gp $(filter-out $(foreach f,$(drawn),$(script_of_$f)),$(wildcard $(dir $(2))*.gp)) \
  build/data/$(1).tsv $(PUBLISHED) | deps build/figures
	@echo "drawing $(1)"; $(call draw_both,$(1),build/data,build/figures/$(1))
endef
$(foreach f,$(drawn),$(eval $(call figure_rule,$f,$(script_of_$f))))
# One figure draws the data of a second experiment beside its own.
build/figures/order_verification.pdf build/figures/order_verification.png: build/data/constructions.tsv

gallery: deps ## Redraw the pictures of README and of the guide
	@$(configure) && $(compile) pictures && mkdir -p build/pictures && $(BIN)/pictures build/pictures \
	  && gnuplot -e "data='build/pictures'; output='build/pictures'" lib/docs/pictures/pictures.gp
	@for each in build/pictures/*.png; do tail -c 8 $$each | grep -aq IEND || { echo "$$each is cut off: no space left?" >&2; exit 1; }; done
	@cp build/pictures/*.png lib/docs/pictures

build/data build/figures build/paper:
	@mkdir -p $@

# ---- longer runs, each into its own folder, with progress on a terminal -------------------------------------------
long: $(patsubst %,build/long/%.tsv,$(with_long)) ## Run to their end what `figures` runs under a cap
build/long/%.tsv: $(BIN)/% | build/data
	$(call alone,$*) $(BIN)/$* --long --output build/long
# $(call draw_all,stems,kind): those figures from build/<kind>, as build/figures/<stem>_<kind>
draw_all = $(foreach f,$(1),$(call draw_both,$f,build/$(2),build/figures/$(f)_$(2)) &&) true
work-precision: deps-peers build/full/work_precision.tsv build/full/front_door.tsv | build/figures ## The whole grid of speed and accuracy
	@$(call draw_all,work_precision front_door,full)
arena: build/full/optimiser_arena.tsv | build/figures ## The arena of optimisers with dimensions up to 1e6: two CPU minutes
	@$(call draw_all,optimiser_arena,full)
build/full/%.tsv: $(BIN)/% | build/data
	$(call alone,$*) $(BIN)/$* --full --output build/full
extremes: $(patsubst %,build/extremes/%.tsv,$(with_extremes)) | build/figures ## The long stability runs
	@$(call draw_all,$(with_extremes),extremes)
build/extremes/%.tsv: $(BIN)/% | build/data
	$(call alone,$*) $(BIN)/$* --extremes --output build/extremes

# ---- paper, documentation, housekeeping ---------------------------------------------------------------------------
# What TeX only warns of (references, glyphs, boxes that stand out) is shown; only the tests fail for it.
# Timed data that exist are kept, see `held`; what lacks is measured.
papers := report stationary bregman
paper: deps-paper deps-peers $(DATA) build/data/manifest.tsv $(FIGURES) build/scorecard.txt | build/paper ## Write the report and the two papers from the data: build/paper/{report,stationary,bregman}.pdf
	@$(compile) paper_numbers && $(BIN)/paper_numbers --paper paper --data build/data --output build/paper
	@for each in $(papers); do \
	  latexmk -cd -pdf -quiet -interaction=nonstopmode -halt-on-error -outdir=../build/paper paper/$$each.tex \
	    >build/paper/latexmk.txt 2>&1 || { tail -n 40 build/paper/latexmk.txt; exit 1; }; \
	  paper/check_log.sh build/paper/$$each.log || true; echo "build/paper/$$each.pdf"; \
	done
docs: deps-docs $(BUILD)/experiments.mk ## Guide, reference, gallery of figures (those that are drawn): build/docs/html
	@lib/docs/site/build.sh $(BUILD)/experiments.tsv && python3 lib/docs/site/check.py build/docs/html && echo "build/docs/html/index.html"
site: deps-site docs ## Publish the docs: SITE=build/site gets them as static files, once a browser has seen every page and formula
	@python3 lib/docs/site/check.py build/docs/html chromium
	@mkdir -p $(call path,$(SITE)) && cp -r build/docs/html/. $(call path,$(SITE)) && touch $(call path,$(SITE)/.nojekyll) && echo "$(SITE): put it on any web server"
format: deps-format ## Apply clang-format
	find lib experiments paper tests -name '*.?pp' | xargs $(clang_format) -i
clean: ## Remove everything that was generated
	rm -rf build
