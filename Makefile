# Thin wrappers over CMake and CTest.  `make run` and `make test` do everything on a fresh Debian 12 machine.
BUILD := build
JOBS  ?= $(shell nproc)
RUN_DIR ?= runs/slot_quick
CTEST := ctest --test-dir $(BUILD) --output-on-failure

.PHONY: run test test-long build setup bench clean format-check tidy sanitize
run: build
	@echo "== running cases/slot_quick into $(RUN_DIR)"
	$(BUILD)/bin/cupola run cases/slot_quick/campaign.yaml --run-dir $(RUN_DIR)
	@echo "== report: $(abspath $(RUN_DIR))/report/index.html"

test: build
	@echo "== running the tests"
	$(CTEST) -LE long

test-long: build
	$(CTEST)

build: setup
	@echo "== building"
	cmake --build $(BUILD) -j $(JOBS)

setup:
	@echo "== packages, OpenFOAM headers, configuration"
	@tools/install_packages.sh packages.txt
	@tools/fetch_openfoam_headers.sh .cache
	@[ -f $(BUILD)/build.ninja ] || cmake -S . -B $(BUILD) -G Ninja

bench: build
	@for program in $(BUILD)/bin/bench_*; do [ -x "$$program" ] && echo "== $$program" && "$$program" || true; done

sanitize: setup
	cmake -S . -B build-sanitize -G Ninja -DCMAKE_BUILD_TYPE=RelWithDebInfo -DCUPOLA_SANITIZE=ON
	cmake --build build-sanitize -j $(JOBS)

format-check:
	@git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror

clean:
	rm -rf build build-*
