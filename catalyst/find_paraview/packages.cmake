# Finds what links ParaView; to be included in each folder that does, since imported targets are seen by their folder alone.
set(HDF5_PREFER_PARALLEL ON)  # the solver's HDF5 is the parallel one; two of them do not go together
# ParaView embeds the Python of the system, which need not be the first one on PATH.
find_program(BRECCIA_SYSTEM_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(BRECCIA_SYSTEM_PYTHON)
  set(Python3_EXECUTABLE ${BRECCIA_SYSTEM_PYTHON})
endif()

include(${CMAKE_CURRENT_LIST_DIR}/python_modules.cmake)
# ParaView's own macros are written for these policies of CMake's; CMake 3.31 would warn of each.
set(CMAKE_POLICY_DEFAULT_CMP0174 OLD)
set(CMAKE_POLICY_DEFAULT_CMP0177 OLD)

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
