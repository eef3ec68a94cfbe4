# A thin wrapper of CMake. `make help` lists the targets.

BUILD ?= build
TYPE ?= Release
T ?= .
PREFIX ?= /usr/local
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
SUDO := $(shell [ "$$(id -u)" = 0 ] || echo sudo)

BUILD_PACKAGES := g++ cmake pkg-config libglm-dev libopenmesh-dev libopenimageio-dev libcli11-dev nlohmann-json3-dev
TEST_PACKAGES := libgtest-dev libtinygltf-dev python3 dpkg-dev locales
CHECK_PACKAGES := clang clang-format
WASM_PACKAGES := clang-14 lld-14 llvm-14 wasi-libc libc++-14-dev-wasm32 libc++abi-14-dev-wasm32 libclang-rt-14-dev-wasm32
PORT_PACKAGES := g++-aarch64-linux-gnu qemu-user nodejs $(WASM_PACKAGES)
FUZZ_PACKAGES := clang libclang-rt-14-dev
LINT_PACKAGES := clang-tidy-14 cppcheck
COVERAGE_PACKAGES := gcovr
BENCH_PACKAGES := libbenchmark-dev
PLOT_PACKAGES := gnuplot-nox
PEER_PACKAGES := libembree-dev libegl-dev libgl-dev libgl1-mesa-dri $(PLOT_PACKAGES)
VIEWER_PACKAGES := nodejs npm chromium
WASM_TOOLCHAIN := -Wno-dev -DCMAKE_TOOLCHAIN_FILE=tests/golden/wasm.cmake -DCMAKE_BUILD_TYPE=Release
NODE_WASI := node --no-warnings --experimental-wasi-unstable-preview1 tests/golden/run_wasi.mjs
APT_INSTALL := apt-get install -y --no-install-recommends -o DPkg::Lock::Timeout=500

# Packages of a list that are not installed; none where there is no dpkg to ask.
missing = $(shell command -v dpkg-query >/dev/null && for p in $(1); do \
  dpkg-query -W -f '$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || echo $$p; done)

define install
@set -e; missing="$(call missing,$(1))"; if [ -n "$$missing" ]; then \
  echo "$(SUDO) apt-get update && $(SUDO) $(APT_INSTALL) $$missing"; \
  $(SUDO) apt-get update -qq && DEBIAN_FRONTEND=noninteractive $(SUDO) $(APT_INSTALL) $$missing; fi
endef

# The core alone, built apart with some options of CMake, and the hashes it gives, run by another program
# where this machine cannot: $(call hashes,name,options,runner).
define hashes
@cmake -S . -B $(BUILD)/determinism/$(1) -DHEMICUBE_CORE_ONLY=ON -DHEMICUBE_TESTS=ON $(2) >/dev/null
@cmake --build $(BUILD)/determinism/$(1) --parallel $(JOBS) --target golden_hashes
@echo "== $(1)" && $(3) $(BUILD)/determinism/$(1)/golden_hashes <$(BUILD)/determinism/scenes
endef

.PHONY: all help deps deps-check demo test format format-check determinism determinism-quick sanitize tsan coverage tidy cppcheck fuzz core core-sources install package bench speed solvers refinement embedding growth peers golden check-glb web check-web clean ci

all: ## build build/hemicube (installs nothing)
	@missing="$(call missing,$(BUILD_PACKAGES))"; if [ -n "$$missing" ]; then \
	  echo "missing packages; install them with 'make deps', or:"; \
	  echo "  $(SUDO) $(APT_INSTALL) $$missing"; exit 1; fi
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE)
	@cmake --build $(BUILD) --parallel $(JOBS)

help: ## this list
	@grep -E '^[a-z-]+:.*## ' Makefile | sed -E 's/^([a-z-]+):.*## /\1\t/' | expand -t 16

deps: ## install what building and testing needs (apt-get; sudo where not root)
	$(call install,$(BUILD_PACKAGES) $(TEST_PACKAGES))

deps-check: ## install what the format and determinism checks need besides
	$(call install,$(CHECK_PACKAGES))

demo: deps ## install, build, and light the Cornell box into build/demo/cornell
	@$(MAKE) --no-print-directory all
	@$(BUILD)/hemicube solve scenes/cornell.json -o $(BUILD)/demo/cornell

test: deps ## install, build, and run all tests (T=regex picks some)
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON -DHEMICUBE_WERROR=ON
	@cmake --build $(BUILD) --parallel $(JOBS)
	@cd $(BUILD) && ctest --output-on-failure --parallel $(JOBS) -R '$(T)'

format: deps-check ## format all sources
	@git ls-files '*.h' '*.cpp' '*.inl' '*.c' | xargs clang-format-14 -i

format-check: deps-check ## fail if a source is not formatted
	@git ls-files '*.h' '*.cpp' '*.inl' '*.c' | xargs clang-format-14 --dry-run --Werror

determinism: determinism-quick ## the golden hashes on every compiler, optimisation and processor that there is
	$(call install,$(PORT_PACKAGES))
	$(call hashes,g++-O2,-DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=RelWithDebInfo)
	$(call hashes,g++-static,-DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXE_LINKER_FLAGS=-static)
	$(call hashes,clang++-O0,-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Debug)
	$(call hashes,clang++-O2,-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=RelWithDebInfo)
	$(call hashes,aarch64,-DCMAKE_TOOLCHAIN_FILE=tests/golden/aarch64.cmake -DCMAKE_BUILD_TYPE=Release,qemu-aarch64)
	@cmake --build $(BUILD)/determinism/aarch64 --parallel $(JOBS) --target processor_test
	@qemu-aarch64 $(BUILD)/determinism/aarch64/processor_test --gtest_brief=1
	$(call hashes,wasm,$(WASM_TOOLCHAIN),$(NODE_WASI))

determinism-quick: deps deps-check ## the same with the build folder's compiler, g++ -O0 and clang++ -O3
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON -DHEMICUBE_WERROR=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target pack_scenes --target golden_hashes
	@mkdir -p $(BUILD)/determinism && $(BUILD)/pack_scenes >$(BUILD)/determinism/scenes
	@echo "== $(TYPE), $(BUILD)" && $(BUILD)/golden_hashes <$(BUILD)/determinism/scenes
	$(call hashes,g++-O0,-DCMAKE_CXX_COMPILER=g++ -DCMAKE_BUILD_TYPE=Debug)
	$(call hashes,clang++-O3,-DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release)

# vptr asks for the type information that the core is built without.
sanitize: deps ## all tests under AddressSanitizer and UndefinedBehaviorSanitizer
	@cmake -S . -B $(BUILD)/sanitize -DCMAKE_BUILD_TYPE=Release -DHEMICUBE_TESTS=ON \
	  -DCMAKE_CXX_FLAGS="-fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined \
	    -fno-omit-frame-pointer -g1"
	@cmake --build $(BUILD)/sanitize --parallel $(JOBS)
	@cd $(BUILD)/sanitize && LSAN_OPTIONS=suppressions=$(CURDIR)/tests/support/leaks.txt:print_suppressions=0 \
	  ctest --output-on-failure --parallel $(JOBS) -R '$(T)'

# Where workers could disturb each other.
TSAN_TESTS := balance_test form_factor_property_test golden_test kept_rows_test ladder_property_test \
  other_solvers_test row_store_test shooting_test solver_test thread_pool_test
tsan: deps ## the tests with several workers, and the golden ones, under ThreadSanitizer
	@cmake -S . -B $(BUILD)/tsan -DCMAKE_BUILD_TYPE=Release -DHEMICUBE_TESTS=ON \
	  -DCMAKE_CXX_FLAGS="-fsanitize=thread -fno-omit-frame-pointer -g1"
	@cmake --build $(BUILD)/tsan --parallel $(JOBS) --target $(TSAN_TESTS)
	@cd $(BUILD)/tsan && ctest --output-on-failure --parallel $(JOBS) \
	  -R '$(if $(filter .,$(T)),Thread|Worker|Golden|RowStore|Interrupted,$(T))'

# Left out are a test in which no file may grow, as those of the counters do, and one of installed files,
# which must not name the build folder, as the counters do.
COVERAGE_LEAVES := LimitsTest.AFullDisk|Package.IsFound
CORE_DIRS := $(BUILD)/coverage/CMakeFiles/hemicube_raster.dir $(BUILD)/coverage/CMakeFiles/hemicube_core.dir
coverage: deps ## how much of raster/ and of the core the tests run, by file; fails below 90 % of the lines
	$(call install,$(COVERAGE_PACKAGES))
	@cmake -S . -B $(BUILD)/coverage -DCMAKE_BUILD_TYPE=Release -DHEMICUBE_TESTS=ON \
	  -DCMAKE_CXX_FLAGS_RELEASE="-O1 -DNDEBUG --coverage -fprofile-update=atomic"
	@cmake --build $(BUILD)/coverage --parallel $(JOBS)
	@cd $(BUILD)/coverage && ctest --output-on-failure --parallel $(JOBS) -R '$(T)' -E '$(COVERAGE_LEAVES)'
	@gcovr --root . --exclude-throw-branches --sort-uncovered --fail-under-line 90 $(CORE_DIRS)

tidy: deps ## clang-tidy over raster/ and radiosity/, by .clang-tidy
	$(call install,$(LINT_PACKAGES))
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@git ls-files 'raster/*.cpp' 'radiosity/*.cpp' | xargs -P $(JOBS) -n 4 clang-tidy-14 -p $(BUILD) --quiet \
	    --extra-arg=-Wno-unknown-warning-option # the build folder's compiler may be another

# Left out: members that stay unset (where they do, the code says so), copies in constructors that read
# better there, rows of bytes seen as what they hold, and array elements that are written but taken for read.
CPPCHECK_LEAVES := uninitMemberVar useInitializationList invalidPointerCast constStatement missingInclude
cppcheck: deps ## cppcheck over raster/ and radiosity/
	$(call install,$(LINT_PACKAGES))
	@cppcheck --std=c++20 --language=c++ --enable=warning,performance,portability --inline-suppr --error-exitcode=1 \
	  --quiet -j $(JOBS) -I . $(CPPCHECK_LEAVES:%=--suppress=%) $$(git ls-files 'raster/*.cpp' 'radiosity/*.cpp')

# Readers read files: in memory ten times as many a second as on a disk.
FUZZ_TARGETS ?= $(notdir $(wildcard tests/fuzz/corpus/*))
fuzz: deps ## install clang, feed each fuzz target for T seconds (60) under sanitizers (FUZZ_TARGETS=name... picks some)
	$(call install,$(FUZZ_PACKAGES))
	@cmake -S . -B $(BUILD)/fuzz -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release \
	  -DHEMICUBE_TESTS=ON -DHEMICUBE_FUZZ=ON \
	  -DCMAKE_CXX_FLAGS="-fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined \
	    -fsanitize-coverage-ignorelist=$(CURDIR)/tests/fuzz/coverage_ignore.txt -fno-omit-frame-pointer -g1"
	@cmake --build $(BUILD)/fuzz --parallel $(JOBS) --target hemicube_fuzz
	@set -e; if [ -w /dev/shm ]; then export TMPDIR=/dev/shm; fi; \
	for target in $(FUZZ_TARGETS); do echo "== $$target"; \
	  mkdir -p $(BUILD)/fuzz/corpus/$$target; \
	  HEMICUBE_FUZZ_TARGET=$$target $(BUILD)/fuzz/hemicube_fuzz -max_total_time=$(if $(filter .,$(T)),60,$(T)) \
	    -dict=tests/fuzz/words.dict -max_len=4096 -len_control=20 -timeout=30 -verbosity=0 -print_final_stats=1 \
	    -artifact_prefix=$(BUILD)/fuzz/$$target- $(BUILD)/fuzz/corpus/$$target tests/fuzz/corpus/$$target; done

core: ## the embeddable core alone: a C++20 compiler and GLM
	@cmake -S . -B $(BUILD)/core -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_CORE_ONLY=ON
	@cmake --build $(BUILD)/core --parallel $(JOBS)

core-sources: ## the sources of the core, to be added to another build
	@sed -n '/^add_library(hemicube_\(raster\|c_api\|core\) /,/^)/s/^  \(r.*\.cpp\)$$/\1/p' raster/CMakeLists.txt radiosity/CMakeLists.txt

install: all ## install program, libraries and headers (PREFIX=/usr/local)
	@cmake --install $(BUILD) --prefix $(PREFIX)

package: all ## make a Debian package in the build folder
	@cd $(BUILD) && cpack -G DEB

bench: deps ## hemicubes per second beside their error, and each kernel alone, into bench/results
	$(call install,$(BENCH_PACKAGES))
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target rows_bench --target kernels_bench
	@$(BUILD)/rows_bench bench/results
	@$(BUILD)/kernels_bench --benchmark_min_time=0.05 --benchmark_repetitions=5 --benchmark_enable_random_interleaving=true \
	  --benchmark_report_aggregates_only=true --benchmark_out_format=csv \
	  --benchmark_out=bench/results/kernels.csv

speed: deps ## error against time of every rung of accuracy, table and plots, into bench/results
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target speed_error
	@$(BUILD)/speed_error bench/results
	@if command -v gnuplot >/dev/null; then for table in bench/results/*/speed_error.csv; do \
	  gnuplot -e "folder='$$(dirname $$table)'" bench/speed/plot.gp; done; \
	else echo "speed: no plots without gnuplot ($(SUDO) $(APT_INSTALL) $(PLOT_PACKAGES))"; fi

solvers: deps ## sweeps against plain reading, error against sweeps and time, into bench/results
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target solvers_bench
	@$(BUILD)/solvers_bench bench/results
	@if command -v gnuplot >/dev/null; then for table in bench/results/*/convergence.csv; do \
	  gnuplot -e "folder='$$(dirname $$table)'" bench/solvers/plot.gp; done; \
	else echo "solvers: no plots without gnuplot ($(SUDO) $(APT_INSTALL) $(PLOT_PACKAGES))"; fi

refinement: deps ## error against number of elements, uniform and adaptive meshes, into bench/results
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target refinement_bench
	@$(BUILD)/refinement_bench bench/results
	@if command -v gnuplot >/dev/null; then for table in bench/results/*/refinement.csv; do \
	  gnuplot -e "folder='$$(dirname $$table)'" bench/refinement/plot.gp; done; \
	else echo "refinement: no plots without gnuplot ($(SUDO) $(APT_INSTALL) $(PLOT_PACKAGES))"; fi

embedding: deps ## bytes of code, heap per thread, patch and form factor, time to start, into bench/results
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target embedding --target c_api_room
	@$(BUILD)/embedding $(BUILD)/libhemicube.so $(BUILD)/tests/c_api_room bench/results

GROWTH_OPTIONS ?= --rung hemicube --resolution 128 --threads 2
growth: deps ## time and memory of whole runs of the program on larger and larger scenes, into bench/results
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target hemicube --target growth
	@$(BUILD)/growth $(BUILD)/hemicube bench/results "$(GROWTH_OPTIONS)"
	@if command -v gnuplot >/dev/null; then for table in bench/results/*/growth.csv; do \
	  gnuplot -e "folder='$$(dirname $$table)'" bench/growth/plot.gp; done; \
	else echo "growth: no plots without gnuplot ($(SUDO) $(APT_INSTALL) $(PLOT_PACKAGES))"; fi

peers: deps ## install other programs and time them beside this one into bench/results
	$(call install,$(PEER_PACKAGES))
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target hemicube_peers
	@$(BUILD)/peers bench/results
	@for table in bench/results/*/peers.csv; do \
	  gnuplot -e "folder='$$(dirname $$table)'" bench/peers/plot.gp; done

golden: deps ## rewrite tests/golden/hashes.txt (only for changes that are meant to change results)
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE) -DHEMICUBE_TESTS=ON
	@cmake --build $(BUILD) --parallel $(JOBS) --target golden_test
	@HEMICUBE_WRITE_GOLDEN=1 $(BUILD)/tests/golden_test --gtest_brief=1

check-glb: ## solution.glb in a browser, against its own colours and view.png (needs node, npm, chromium)
	@for tool in node npm chromium; do command -v $$tool >/dev/null || { \
	  echo "check-glb: there is no $$tool; install it, for example with: $(SUDO) $(APT_INSTALL) $(VIEWER_PACKAGES)"; exit 1; }; done
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE)
	@cmake --build $(BUILD) --parallel $(JOBS) --target hemicube
	@$(BUILD)/hemicube solve scenes/cornell.json --rung hemicube --resolution 64 --quiet -o $(BUILD)/viewers/cornell
	@npm install --prefix $(BUILD)/viewers --no-audit --no-fund --loglevel error three@0.160.1 gltf-validator@2.0.0-dev.3.10
	@node tests/viewers/check_glb.mjs $(BUILD)/viewers/cornell $(BUILD)/viewers chromium

web: ## install, and make the page build/web/hemicube.html: the Cornell box, lit in a browser
	$(call install,$(BUILD_PACKAGES) $(WASM_PACKAGES))
	@cmake -S . -B $(BUILD) -DCMAKE_BUILD_TYPE=$(TYPE)
	@cmake --build $(BUILD) --parallel $(JOBS) --target make_page
	@cmake -S . -B $(BUILD)/web/module -DHEMICUBE_CORE_ONLY=ON $(WASM_TOOLCHAIN) >/dev/null
	@cmake --build $(BUILD)/web/module --parallel $(JOBS) --target page
	@$(BUILD)/make_page $(BUILD)/web/module/page.wasm scenes/cornell.json radiosity/web $(BUILD)/web/hemicube.html

WEB_RESOLUTIONS := 128 64
check-web: ## the page in a browser, against the native program: F, pictures, every control (needs node, npm, chromium)
	@for tool in node npm chromium; do command -v $$tool >/dev/null || { \
	  echo "check-web: there is no $$tool; install it, for example with: $(SUDO) $(APT_INSTALL) $(VIEWER_PACKAGES)"; exit 1; }; done
	@$(MAKE) --no-print-directory web
	@cmake --build $(BUILD) --parallel $(JOBS) --target hemicube
	@for resolution in $(WEB_RESOLUTIONS); do $(BUILD)/hemicube solve scenes/cornell.json --rung hemicube --resolution $$resolution \
	  --solver progressive --quiet -o $(BUILD)/web/native_$$resolution && \
	  $(BUILD)/hemicube formfactors scenes/cornell.json --rung hemicube --resolution $$resolution --quiet --json \
	  >$(BUILD)/web/native_$$resolution/form_factors.json || exit 1; done
	@npm install --prefix $(BUILD)/web --no-audit --no-fund --loglevel error playwright-core@1.65.1
	@node tests/web/check_web.mjs $(BUILD)/web $$(command -v chromium) $(WEB_RESOLUTIONS)

ci: test format-check determinism-quick ## what .ci/run runs

clean: ## delete the build folder
	@rm -rf $(BUILD)
