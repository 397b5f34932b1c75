# Finds what links ParaView; to be included in each folder that does, since imported targets are seen by their folder alone.
set(HDF5_PREFER_PARALLEL ON)  # the solver's HDF5 is the parallel one; two of them do not go together
# ParaView embeds the Python of the system, which need not be the first one on PATH.
find_program(BRECCIA_SYSTEM_PYTHON NAMES python3 PATHS /usr/bin NO_DEFAULT_PATH)
if(BRECCIA_SYSTEM_PYTHON)
  set(Python3_EXECUTABLE ${BRECCIA_SYSTEM_PYTHON})
endif()
find_package(MPI REQUIRED COMPONENTS C CXX)
find_package(X11 REQUIRED)
find_package(ParaView 5.11 REQUIRED)
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)
