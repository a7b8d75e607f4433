# The verbs of the project. `make` alone lists them.

CARGO ?= cargo
PLOT ?= run.svg
PYTHONS ?= python3
# Cases of each of seven parsers, and of each of four laws.
CASES ?= 1670000
MOTIONS ?= 25000
# Changed documents, each through one of the commands that read it.
DOCUMENTS ?= 1000000
# Of `make alone`.
MINUTES ?= 30
# Of `make instructions`.
BEFORE ?= HEAD~1
# Runs of `make judge`.
RUNS ?= 1000

# Builds for a first look (SVG and animations), shows the command as a user would type it, and runs it.
trial := -p stickslip-cli --profile trial --no-default-features --features animation
stickslip = $(CARGO) build --locked $(trial) && echo 'stickslip $(1)' \
	&& $(CARGO) run --locked $(trial) --quiet -- $(1)

.DEFAULT_GOAL := help
.PHONY: help run test test-python test-slurm wheel packages deny alone instructions survive judge check wasm outputs bench work-precision \
	reference timings figures pictures peers fuzz doc install site test-site dist reproducible clean

help: ## list these verbs
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sed -E 's/:.*## /\t/' | expand -t 18

run: ## a first run: a tip that comes to stick and slip, its surface, a picture (run.svg) and an animation (run.gif)
	@$(call stickslip,run --alpha 1.2 --r 1 --kick 0.05 --until 200 -o run.json --plot $(PLOT))
	@$(call stickslip,surface run.json --at 200 --range 130:200 --spacing 0.02 -o surface.csv)
	@$(call stickslip,plot run.json -o run.gif)
	@echo 'A first look, compiled without optimisation: the program of make install integrates some 30 times as fast.'

test: ## all tests of the workspace
	$(CARGO) test --workspace --locked

test-python: ## the Python package in a clean environment: the program's numbers, stubs, examples; PYTHONS names interpreters
	crates/python/test $(PYTHONS)

test-slurm: ## examples/slurm with a controller and a node of Slurm started here; skipped with a word where it is not installed
	$(CARGO) build --release --locked
	tests/slurm/run.py target/release/stickslip

wheel: ## the Python package for Linux of glibc 2.28 and later, x86-64 and arm64, and its sources for pip, in target/wheels
	crates/python/wheel

packages: ## the crates that are published, each built from its packaged sources, in target/package
	$(CARGO) package --locked --workspace --exclude stickslip-cli --exclude stickslip-grid --exclude stickslip-reproduction --exclude stickslip-tables --exclude stickslip-benches

deny: ## licences, sources and bans of all that is built, for each lock file
	.ci/deny

alone: ## the .deb of `make dist` in a root with nothing else; and a soak of its program for MINUTES
	packages/alone.sh target/dist/stickslip_*_amd64.deb
	packages/soak.py target/dist/stickslip-*-x86_64-unknown-linux-gnu/stickslip --minutes $(MINUTES)

instructions: ## is a kernel over 5 % dearer than in the commit BEFORE? counted by valgrind
	.ci/instructions $(BEFORE)

survive: ## the long tests: 300 kills, 200 pairs of writers, 500 flipped bits, 400 tips, 500 tables, 3,000 extreme lines, signals; 400 measured profiles, 800 fitted ripples, 150 other fits; 200 random rasters
	$(CARGO) test --release --locked --test survival -- --ignored --nocapture --test-threads 1
	$(CARGO) test --release --locked -p stickslip-measurement -- --ignored --nocapture
	$(CARGO) test --release --locked -p stickslip-raster --test raster -- --ignored --nocapture

judge: ## 1,000 random runs, each against one ten times as long: regimes, errors, prospects
	CASES=$(RUNS) $(CARGO) test --release --locked -p stickslip-outcome --test judged_runs -- --ignored --nocapture

check: ## what a change must pass: format, clippy, tests, docs, benches compile
	$(CARGO) fmt --all --check
	$(CARGO) clippy --workspace --all-targets --locked -- -D warnings
	$(CARGO) clippy -p stickslip-cli --no-default-features --locked -- -D warnings
	$(CARGO) test --workspace --locked
	RUSTDOCFLAGS="-D warnings" $(CARGO) doc --workspace --no-deps --locked
	$(CARGO) bench --workspace --locked --no-run

wasm: ## what is to run in a browser compiles for it: documents, figures (rustup's target, or Debian's rustc-web)
	.ci/wasm

outputs: ## do two builds write the same, but for the changes in tests/outputs: OLD=path of the other program
	$(CARGO) build --release --locked
	tests/outputs/compare.py $(OLD) target/release/stickslip

bench: ## measure: cost per step, whole runs, surfaces
	@echo "memory: cost of a step against the history within reach; fft is flat, direct is linear"
	$(CARGO) bench --locked --bench memory
	@echo "runs: whole runs of the regimes, by tolerance"
	$(CARGO) bench --locked --bench runs
	@echo "surface: reconstruction against the number of points, fft and direct"
	$(CARGO) bench --locked --bench surface
	@echo "cycles: a cycle with its multipliers, from onset to relaxation, and a branch of them"
	$(CARGO) bench --locked --bench cycles

work-precision: ## measure time against error, into data/work_precision.json, which `figures` draws
	$(CARGO) run --release --locked --example work_precision -- data/work_precision.json

reference: ## write the schemas and tables of parameters anew, from the types, and the generated pages of docs/reference, from `--help` and the schemas
	STICKSLIP_WRITE_REFERENCE=1 $(CARGO) test --locked -p stickslip-cli --test program reference::schemas
	STICKSLIP_WRITE_REFERENCE=1 $(CARGO) test --locked -p stickslip-cli --test program reference::

timings: ## time whole commands, processor and memory, into data/commands.json, which README.md and docs quote (two minutes)
	$(CARGO) build --release --locked
	benches/commands.py target/release/stickslip data/commands.json

figures: ## the paper's figures, and its numbers beside ours, in target/figures
	$(CARGO) run --release --locked -p stickslip-cli -- figures --out-dir target/figures

pictures: ## the pictures of the book, drawn anew in docs/figures (minutes); WORD draws those with it in their names
	$(CARGO) build --release --locked
	docs/figures/draw $(WORD)

peers: ## race other programs on one problem at matched error: data/peers.json, data/peers.md
	python3 peers/race.py data

fuzz: ## millions of mutated files, command lines and documents, 100,000 random motions; CASES, DOCUMENTS and MOTIONS set how many
	PROPTEST_CASES=$(CASES) $(CARGO) test --release --locked -p stickslip-cli --lib fuzz::any -- --nocapture
	PROPTEST_CASES=$(DOCUMENTS) $(CARGO) test --release --locked -p stickslip-cli --lib fuzz_documents -- --nocapture
	PROPTEST_CASES=$(MOTIONS) $(CARGO) test --release --locked --test science properties

doc: ## the libraries' documentation, in target/doc
	$(CARGO) doc --workspace --no-deps --locked

install: ## put `stickslip` among cargo's binaries
	$(CARGO) install --locked --path crates/cli

site: ## the book and the page to play with, in target/site (needs node and a standard library for wasm32)
	.ci/site

test-site: ## the page in a Chromium beside the program, and every link of the book; pictures in target/site-shots
	.ci/site
	cd crates/web && node --test test/crew.test.mjs test/parameters.test.mjs test/site.test.mjs test/page.test.mjs

dist: ## for Linux, in target/dist: archives and .deb for x86-64 and arm64 with man pages, completions and notices; lists of parts; checksums
	.ci/dist

reproducible: ## are the packages of two clones the same bytes? builds them twice
	.ci/reproducible x86_64

clean: ## remove what building made
	$(CARGO) clean
