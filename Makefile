# Thin wrappers over CMake and CTest.  `make run` and `make test` do everything on a fresh Debian 12 machine.
BUILD   := build
JOBS    ?= $(shell nproc)
RUN_DIR ?= runs/slot_quick
# Programs of Open MPI refuse to run as root unless told so; in a container root is all there is.
ROOT_MAY_RUN_MPI := $(if $(filter 0,$(shell id -u)),OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
# What tests take says nothing about campaigns: no rates are kept.
CTEST := $(ROOT_MAY_RUN_MPI) CUPOLA_RATES= ctest --output-on-failure -j $(JOBS)

.PHONY: run test test-long test-slurm setup setup-tests build bench bench-reference sanitize fuzz tidy tidy-all format-check clean

run: build
	@echo "== running cases/slot_quick into $(RUN_DIR)"
	@status=0; $(BUILD)/bin/cupola run cases/slot_quick/campaign.yaml --run-dir "$(RUN_DIR)" || status=$$?; \
	[ ! -f "$(RUN_DIR)/report/index.html" ] || echo "== report: $$(realpath "$(RUN_DIR)")/report/index.html"; exit $$status

test: build setup-tests
	@echo "== running the tests"
	$(CTEST) --test-dir $(BUILD) -LE long

test-long: build setup-tests
	@echo "== running all tests, the long ones too"
	$(CTEST) --test-dir $(BUILD)
	@$(MAKE) fuzz FUZZ_SECONDS=600

test-slurm: build
	@echo "== a real Slurm of one node, started by the test"
	$(CTEST) --test-dir $(BUILD) -L slurm

setup:
	@echo "== packages, OpenFOAM headers"
	@tools/install_packages.sh packages.txt
	@tools/fetch_openfoam_headers.sh .cache

setup-tests:
	@tools/install_packages.sh packages_for_tests.txt

build: setup
	@echo "== configuring and building"
	@[ -f $(BUILD)/build.ninja ] || cmake -S . -B $(BUILD) -G Ninja
	cmake --build $(BUILD) -j $(JOBS)

bench: build
	@tools/run_benchmarks.sh $(BUILD)

# The tracer stage's reference at full size: hours; goes on where it was interrupted.  Its reduced field is kept with the sources.
REFERENCE_STEP ?= 0.25
bench-reference: build
	$(BUILD)/bin/bench_tracer reference --step $(REFERENCE_STEP) --ranks 2

# The address and undefined-behaviour sanitizers on the programs and on the unit and workflow tests, in a tree of their own.
# Without those that look at pages in a browser.  Leaks are not looked for: OpenFOAM, LIGGGHTS and Open MPI keep what they hold until the process ends.
sanitize: setup
	@echo "== sanitizers"
	@[ -f build-sanitize/build.ninja ] || cmake -S . -B build-sanitize -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
	  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=10 -DCUPOLA_SANITIZE=ON -DCUPOLA_WARNINGS_AS_ERRORS=OFF
	cmake --build build-sanitize -j $(JOBS) --target sanitized
	ASAN_OPTIONS=detect_leaks=0 UBSAN_OPTIONS=halt_on_error=1:print_stacktrace=1 $(CTEST) --test-dir build-sanitize -L 'unit|workflow' -LE long -E 'browser|serve|study.figures'

# Fuzzers of the campaign reader and of the readers of HDF5: the kept corpus is replayed, then FUZZ_SECONDS each for something new.
FUZZ_SECONDS ?= 60
fuzz: setup
	@echo "== fuzzers"
	@[ -f build-fuzz/build.ninja ] || CC=clang CXX=clang++ cmake -S . -B build-fuzz -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG="-O1 -g1" \
	  -DCUPOLA_SANITIZE=ON -DCUPOLA_FUZZ=ON -DCUPOLA_WARNINGS_AS_ERRORS=OFF
	cmake --build build-fuzz -j $(JOBS) --target fuzzers
	@FUZZ_SEED=$(FUZZ_SEED) tools/fuzz.sh build-fuzz $(FUZZ_SECONDS)

tidy: build
	@tools/tidy.sh $(BUILD) physics/closures physics/motion

tidy-all: build
	@tools/tidy.sh $(BUILD) schemas physics stage_dem stage_tracer orchestrator

format-check:
	@git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror && echo "format: fine"

clean:
	rm -rf build build-sanitize build-fuzz
