# libsemblante alone, for phones, boards and other systems: nothing of the server, of the tests or of OpenGL is asked for.
find_package(draco CONFIG QUIET)
option(SEMBLANTE_DRACO "Decode mesh.drc in libsemblante; without, the caller passes the decoded mesh" ${draco_FOUND})
if(SEMBLANTE_DRACO AND NOT draco_FOUND)
  find_package(draco CONFIG REQUIRED)
endif()

# EXCLUDE_FROM_ALL: of these only what the library takes is built.
add_subdirectory(core EXCLUDE_FROM_ALL)
add_subdirectory(protocol EXCLUDE_FROM_ALL)
add_subdirectory(clients)
if(SEMBLANTE_ANDROID)
  add_subdirectory(clients/native/android)
endif()
