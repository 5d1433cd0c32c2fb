# libsemblante.a: all objects as one, in which nothing but the exported names is global. It cannot clash with the names of a
# program, and no order of archives is to be known.
file(STRINGS ${exports} lines REGEX "semblante_[a-z0-9_]+;")
list(TRANSFORM lines REPLACE "^ *([a-z0-9_]+);.*" "\\1" OUTPUT_VARIABLE names)
list(JOIN names "\n" text)
set(names_file ${CMAKE_CURRENT_BINARY_DIR}/exported_names.txt)
file(CONFIGURE OUTPUT ${names_file} CONTENT "${text}\n")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${exports})
list(TRANSFORM names PREPEND -Wl,--undefined= OUTPUT_VARIABLE roots)

set(one_object ${CMAKE_CURRENT_BINARY_DIR}/libsemblante.o)
set(join -r -nostdlib -Wl,--force-group-allocation -Wl,--gc-sections)
if(lto_link)
  list(APPEND join ${lto_link} -fPIC -flinker-output=nolto-rel)
endif()
add_custom_command(OUTPUT ${one_object}
  COMMAND ${CMAKE_CXX_COMPILER} ${join} ${roots} ${objects} -o ${one_object}
  COMMAND ${CMAKE_OBJCOPY} --keep-global-symbols=${names_file} ${one_object}
  DEPENDS ${objects} ${names_file}
  COMMAND_EXPAND_LISTS VERBATIM COMMENT "Joining the objects of libsemblante.a")
add_library(semblante_static STATIC ${one_object})
set_source_files_properties(${one_object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
set_target_properties(semblante_static PROPERTIES
  OUTPUT_NAME semblante
  LINKER_LANGUAGE CXX
  ARCHIVE_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)

# What a program must link beside it, as plain names: the C++ library of this compiler, and Draco.
set(private_libraries m)
foreach(library stdc++ c++)
  if(library IN_LIST CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
    list(PREPEND private_libraries ${library})
  endif()
endforeach()
if(SEMBLANTE_DRACO)
  list(PREPEND private_libraries draco)
endif()
target_link_libraries(semblante_static INTERFACE ${private_libraries})
