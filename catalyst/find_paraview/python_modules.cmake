# The CMake files of ParaView 5.13 in Debian 13 name its Python modules by files (vtkCommonCore.so) that the packages install under another
# name (vtkCommonCore.cpython-313-x86_64-linux-gnu.so), and end the search there. Nothing here links these modules: where all
# targets of such a list exist already, CMake passes the list over.
function(breccia_declare_python_modules paraview_folder)
  file(GLOB lists ${paraview_folder}/*Python*-targets.cmake ${paraview_folder}/vtk/*Python-targets.cmake)
  foreach(file ${lists})
    file(STRINGS ${file} expected REGEX "^foreach\\(_cmake_expected_target IN ITEMS")
    string(REGEX MATCHALL "[A-Za-z]+::[A-Za-z0-9_.]+" targets "${expected}")
    foreach(target ${targets})
      if(NOT TARGET ${target})
        add_library(${target} INTERFACE IMPORTED)
      endif()
    endforeach()
  endforeach()
endfunction()
file(GLOB paraview_folders ${ParaView_DIR} /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*)
foreach(folder ${paraview_folders})
  breccia_declare_python_modules(${folder})
endforeach()
