# Says which pybind11 CMake would take (setup.py asks). None is as new as asked for here, so each is looked at and none read.
cmake_minimum_required(VERSION 3.22)
find_package(pybind11 9999 QUIET)
message(STATUS "pybind11 ${pybind11_CONSIDERED_VERSIONS}")
