# What links ParaView's window, once ParaView is found: to be included in each folder that does.
find_package(ParaView 5.11 REQUIRED COMPONENTS pqApplicationComponents pqComponents pqPython)
