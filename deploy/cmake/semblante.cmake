# Helpers shared by every folder's CMakeLists.txt.
include(CheckCXXCompilerFlag)

# Warnings and sanitizers for our own targets only: other people's headers come in as SYSTEM.
add_library(semblante_flags INTERFACE)
target_compile_options(semblante_flags INTERFACE -Wall -Wextra -Werror)
# For core and protocol, which libsemblante is made of: the linker can leave out each function by itself, though several
# files were compiled together.
set(SEMBLANTE_SDK_FLAGS -ffunction-sections -fdata-sections)
# Of the objects that become libsemblante: small, no sum fused (the same bits on every machine), and calls between functions of
# the library go directly. Exceptions stay: they are how an allocation fails, and none leaves the library.
set(SEMBLANTE_SDK_OBJECT_FLAGS -ffp-contract=off -fvisibility-inlines-hidden $<$<COMPILE_LANGUAGE:CXX>:-fno-rtti>)
foreach(flag -fno-semantic-interposition -fno-gnu-unique)
  string(MAKE_C_IDENTIFIER SEMBLANTE_HAS${flag} known)
  check_cxx_compiler_flag(${flag} ${known})
  if(${known})
    list(APPEND SEMBLANTE_SDK_OBJECT_FLAGS $<$<COMPILE_LANGUAGE:CXX>:${flag}>)
  endif()
endforeach()
# The parts of libsemblante are optimized as one, where only the names of the header are used from outside: 7 % smaller. GCC's
# alone, whose linker also joins them into the one object of the static library.
set(SEMBLANTE_SDK_LTO_FLAGS)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_BUILD_TYPE STREQUAL Release AND NOT SEMBLANTE_SANITIZE)
  set(SEMBLANTE_SDK_LTO_FLAGS -flto=auto)
endif()
if(SEMBLANTE_UNITY AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # A type of a .cpp file may have members of its anonymous namespace; compiled together, GCC takes the file for a header.
  target_compile_options(semblante_flags INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
endif()
# Hardening of every program: a check of the stack around arrays, and tables of functions that the loader resolves at the
# start and then write-protects. _FORTIFY_SOURCE checks what the sanitizers check better.
target_compile_options(semblante_flags INTERFACE -fstack-protector-strong)
target_link_options(semblante_flags INTERFACE -Wl,-z,relro,-z,now)
if(NOT SEMBLANTE_SANITIZE AND NOT SEMBLANTE_FUZZ)
  target_compile_definitions(semblante_flags INTERFACE $<$<CONFIG:Release>:_FORTIFY_SOURCE=2>)
endif()
if(SEMBLANTE_SANITIZE)
  target_compile_options(semblante_flags INTERFACE -fsanitize=${SEMBLANTE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(semblante_flags INTERFACE -fsanitize=${SEMBLANTE_SANITIZE})
endif()
# Targets with Asio coroutines say so by this property. clang-14 cannot emit a coroutine with UndefinedBehaviorSanitizer's
# check of function pointers; ThreadSanitizer does not see fences, which Asio has beside its mutexes and in its counters of
# references: Boost's counters have none.
set(coroutines $<BOOL:$<TARGET_PROPERTY:SEMBLANTE_COROUTINES>>)
if(SEMBLANTE_SANITIZE MATCHES undefined AND CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  target_compile_options(semblante_flags INTERFACE $<${coroutines}:-fno-sanitize=function>)
elseif(SEMBLANTE_SANITIZE STREQUAL thread)
  target_compile_definitions(semblante_flags INTERFACE "$<${coroutines}:BOOST_ASIO_DISABLE_FENCED_BLOCK;BOOST_ASIO_DISABLE_STD_ATOMIC>")
endif()
if(SEMBLANTE_FUZZ)
  # Coverage for the code under test; the driver is linked by the fuzz targets alone.
  target_compile_options(semblante_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(semblante_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# semblante_library(NAME SOURCES ... DEPENDS ... [HOT] [COLD] [SDK]): a static library `semblante_NAME`, alias `semblante::NAME`,
# whose headers are included from the top of the tree: #include "core/types/mesh.h". HOT: tests/bench measures its loops,
# so it gets -O3. COLD: runs once for a request or a file, so it gets -O1, which compiles in half the time. SDK: a part of
# libsemblante, for which `semblante_NAME_sdk` has its objects.
function(semblante_library name)
  cmake_parse_arguments(ARG "HOT;COLD;SDK" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target semblante_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS} semblante_flags)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:$<$<BOOL:${ARG_HOT}>:-O3>$<$<BOOL:${ARG_COLD}>:-O1>>)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} INTERFACE ${ARG_DEPENDS})
  endif()
  add_library(semblante::${name} ALIAS ${target})
  if(ARG_SDK)
    add_library(${target}_sdk OBJECT EXCLUDE_FROM_ALL ${ARG_SOURCES})
    target_include_directories(${target}_sdk PRIVATE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target}_sdk PRIVATE ${ARG_DEPENDS} ${ARG_PRIVATE_DEPENDS} semblante_flags)
    target_compile_options(${target}_sdk PRIVATE $<$<CONFIG:Release>:-Os> ${SEMBLANTE_SDK_OBJECT_FLAGS} ${SEMBLANTE_SDK_LTO_FLAGS})
  endif()
endfunction()

# Targets for the narrower test configurations of tests/run, which build no more than they run.
add_custom_target(sanitize_tests)
add_custom_target(threads_tests)
add_custom_target(fuzz_targets)

# Seconds after which ctest ends a test. Far more than any takes on a busy machine or under a sanitizer: only a hang
# lasts so long.
set(SEMBLANTE_TEST_TIMEOUT 3600)

# semblante_test(NAME SOURCES ... DEPENDS ... [QUICK] [THREADS] [PROCESSES]): a GoogleTest program whose cases
# ctest runs one by one. A test's own code is compiled with -O1, because each case runs only once. QUICK: the cases compute
# so little that -O0 is enough. THREADS: worth a run under ThreadSanitizer. PROCESSES: starts our programs, so it belongs to
# the normal build and not to AddressSanitizer's unit runs. Put a folder's tests into one program: unity builds then parse
# GoogleTest's and other headers once for several files.
function(semblante_test name)
  cmake_parse_arguments(ARG "QUICK;THREADS;PROCESSES" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main GTest::gmock semblante_flags)
  target_compile_options(test_${name} PRIVATE $<$<CONFIG:Release>:$<IF:$<BOOL:${ARG_QUICK}>,-O0,-O1>>)
  target_compile_definitions(test_${name} PRIVATE SEMBLANTE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SEMBLANTE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  set(labels "")
  if(ARG_PROCESSES)
    list(APPEND labels processes)
  else()
    list(APPEND labels sanitize)
    add_dependencies(sanitize_tests test_${name})
  endif()
  if(ARG_THREADS)
    list(APPEND labels threads)
    add_dependencies(threads_tests test_${name})
  endif()
  # One word: gtest_discover_tests would take a list apart into further properties. `ctest -L` searches within it.
  list(JOIN labels "-" labels)
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 600 PROPERTIES LABELS "${labels}" TIMEOUT ${SEMBLANTE_TEST_TIMEOUT})
endfunction()

# semblante_fuzz(NAME SOURCES ... DEPENDS ...): a libFuzzer program `fuzz_NAME`.
function(semblante_fuzz name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(fuzz_${name} ${ARG_SOURCES})
  target_link_libraries(fuzz_${name} PRIVATE ${ARG_DEPENDS} semblante_flags)
  target_link_options(fuzz_${name} PRIVATE -fsanitize=fuzzer)
  add_dependencies(fuzz_targets fuzz_${name})
endfunction()
