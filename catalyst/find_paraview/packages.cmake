# Finds what links ParaView; to be included in each folder that does, since imported targets are seen by their folder alone.
set(HDF5_PREFER_PARALLEL ON)  # the solver's HDF5 is the parallel one; two of them do not go together
# ParaView embeds the Python of the system, which need not be the first one on PATH.
find_program(BRECCIA_SYSTEM_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(BRECCIA_SYSTEM_PYTHON)
  set(Python3_EXECUTABLE ${BRECCIA_SYSTEM_PYTHON})
endif()

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

find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(X11 REQUIRED)
find_package(ParaView 5.11 REQUIRED COMPONENTS Catalyst PythonCatalyst RemotingLive RemotingServerManager VTKExtensionsCore)
# Asked for by components, ParaView needs a fraction of its development packages, but still names targets of the others: libraries
# that its own have been linked with, which nothing here uses.
foreach(target Boost::boost Freetype::Freetype GLEW::GLEW LibXml2::LibXml2 NetCDF::NetCDF OpenGL::EGL OpenGL::GLX OpenGL::OpenGL hdf5::hdf5_hl)
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED)
  endif()
endforeach()
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
