# Inside another project: the names that an installed package gives its libraries (cmake/install.cmake).
foreach(library IN ITEMS system files heights meshes subjects identity renderer certificate recorder run reference properties certify
                         experiments apparatus preparation)
  if(TARGET forceshade_${library} AND NOT TARGET forceshade::${library})
    add_library(forceshade::${library} ALIAS forceshade_${library})
  endif()
endforeach()
foreach(library IN ITEMS c reference-c)
  string(REPLACE "-" "_" target forceshade_${library})
  if(TARGET ${target})
    add_library(forceshade::${library} ALIAS ${target})
  endif()
endforeach()
