# Helpers shared by every folder's CMakeLists.txt.

# Warnings and sanitizers for our own targets only: other people's headers come in as SYSTEM.
add_library(semblante_flags INTERFACE)
target_compile_options(semblante_flags INTERFACE -Wall -Wextra -Werror)
if(SEMBLANTE_SANITIZE)
  target_compile_options(semblante_flags INTERFACE -fsanitize=${SEMBLANTE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  target_link_options(semblante_flags INTERFACE -fsanitize=${SEMBLANTE_SANITIZE})
endif()
if(SEMBLANTE_FUZZ)
  # Coverage for the code under test; the driver is linked by the fuzz targets alone.
  target_compile_options(semblante_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_link_options(semblante_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# semblante_library(NAME SOURCES ... DEPENDS ...): a static library `semblante_NAME`, alias `semblante::NAME`,
# whose headers are included from the top of the tree: #include "core/types/mesh.h".
function(semblante_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS;PRIVATE_DEPENDS" ${ARGN})
  set(target semblante_${name})
  if(ARG_SOURCES)
    add_library(${target} STATIC ${ARG_SOURCES})
    target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} PUBLIC ${ARG_DEPENDS} PRIVATE ${ARG_PRIVATE_DEPENDS} semblante_flags)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${PROJECT_SOURCE_DIR})
    target_link_libraries(${target} INTERFACE ${ARG_DEPENDS})
  endif()
  add_library(semblante::${name} ALIAS ${target})
endfunction()

# semblante_test(NAME SOURCES ... DEPENDS ...): a GoogleTest program whose cases ctest runs one by one.
function(semblante_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPENDS" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_DEPENDS} GTest::gtest_main GTest::gmock semblante_flags)
  target_compile_definitions(test_${name} PRIVATE SEMBLANTE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" SEMBLANTE_BINARY_DIR="${PROJECT_BINARY_DIR}")
  gtest_discover_tests(test_${name} DISCOVERY_TIMEOUT 60)
endfunction()
