# Finds Qt and the VTK inside ParaView, the one that the in-situ adaptor uses too. To be included in each folder that links them.
set(HDF5_PREFER_PARALLEL ON)
# Libraries that VTK's own have been linked with, which nothing here uses.
foreach(target Boost::boost Freetype::Freetype GLEW::GLEW LibXml2::LibXml2 NetCDF::NetCDF OpenGL::EGL OpenGL::GLX OpenGL::OpenGL hdf5::hdf5 hdf5::hdf5_hl)
  if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED)
  endif()
endforeach()
set(BRECCIA_VTK_MODULES ChartsCore CommonCore CommonDataModel FiltersCore FiltersGeometry FiltersSources GUISupportQt IOHDF IOImage InteractionStyle
  RenderingAnnotation RenderingContext2D RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2 RenderingUI ViewsContext2D)
include(${CMAKE_CURRENT_LIST_DIR}/../../catalyst/find_paraview/python_modules.cmake)
file(GLOB vtk_folders /usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/paraview-*/vtk)
find_package(VTK 9.2 REQUIRED COMPONENTS ${BRECCIA_VTK_MODULES} PATHS ${ParaView_DIR}/vtk ${vtk_folders} NO_DEFAULT_PATH)
set(BRECCIA_QT Qt${VTK_QT_VERSION})
find_package(${BRECCIA_QT} REQUIRED COMPONENTS Widgets Concurrent)
list(TRANSFORM BRECCIA_VTK_MODULES PREPEND "VTK::")
