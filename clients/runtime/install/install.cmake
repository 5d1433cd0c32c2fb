# What others build against: one header, the two libraries, and how CMake and pkg-config find them.
include(CMakePackageConfigHelpers)
set(made ${CMAKE_CURRENT_BINARY_DIR}/install)

# One header for all: those of the kernel take the places where semblante.h includes them.
function(append_header file into)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${file})
  get_property(seen GLOBAL PROPERTY semblante_headers_seen)
  if(file IN_LIST seen)
    return()
  endif()
  set_property(GLOBAL APPEND PROPERTY semblante_headers_seen ${file})
  file(READ ${PROJECT_SOURCE_DIR}/${file} rest)
  set(text "${${into}}")
  while(rest MATCHES "#include \"([^\"]+)\"\n")
    set(included ${CMAKE_MATCH_1})
    string(FIND "${rest}" "#include \"${included}\"\n" at)
    string(SUBSTRING "${rest}" 0 ${at} before)
    string(APPEND text "${before}")
    string(LENGTH "#include \"${included}\"\n" length)
    math(EXPR at "${at} + ${length}")
    string(SUBSTRING "${rest}" ${at} -1 rest)
    append_header(${included} text)
  endwhile()
  set(${into} "${text}${rest}" PARENT_SCOPE)
endfunction()
set_property(GLOBAL PROPERTY semblante_headers_seen)
set(header "")
append_header(clients/runtime/semblante.h header)
file(CONFIGURE OUTPUT ${made}/semblante.h CONTENT "${header}" @ONLY)

foreach(target semblante_shared semblante_static)
  target_include_directories(${target} INTERFACE $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endforeach()

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/semblante)
configure_package_config_file(install/semblanteConfig.cmake.in ${made}/semblanteConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${made}/semblanteConfigVersion.cmake COMPATIBILITY SameMinorVersion)

# Relative to its own place, so that the folder can be moved.
file(RELATIVE_PATH prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_pc "${prefix_from_pc}")
list(TRANSFORM private_libraries PREPEND -l OUTPUT_VARIABLE pc_private_libraries)
list(JOIN pc_private_libraries " " pc_private_libraries)
configure_file(install/semblante.pc.in ${made}/semblante.pc @ONLY)

install(TARGETS semblante_shared semblante_static EXPORT semblante
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime)
install(EXPORT semblante NAMESPACE semblante:: FILE semblanteTargets.cmake DESTINATION ${package_folder} COMPONENT runtime)
install(FILES ${made}/semblanteConfig.cmake ${made}/semblanteConfigVersion.cmake DESTINATION ${package_folder} COMPONENT runtime)
install(FILES ${made}/semblante.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT runtime)
install(FILES ${made}/semblante.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/semblante COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libsemblante COMPONENT runtime)
