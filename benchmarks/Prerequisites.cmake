# Sets VTKIBL_CAN_BENCHMARK, or VTKIBL_CANNOT_BENCHMARK to the reason. Included by this folder and by tests/benchmarks,
# each of which needs the imported targets.
set(VTKIBL_CAN_BENCHMARK OFF)
set(VTKIBL_CANNOT_BENCHMARK "")
if(NOT VTKIBL_BUILD_TESTING)
  set(VTKIBL_CANNOT_BENCHMARK "they are judged by the tests' reference; set VTKIBL_BUILD_TESTING")
  return()
endif()
# VTK's own targets are the parent folder's; what these further modules ask for (JsonCpp, say) must be visible from there.
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
find_package(VTK QUIET COMPONENTS
  ChartsCore CommonCore CommonDataModel FiltersGeneral FiltersSources IOExport IOImage InteractionStyle
  RenderingContext2D
  RenderingContextOpenGL2 RenderingCore RenderingFreeType RenderingOpenGL2 ViewsContext2D)
set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL OFF)
find_package(OpenGL QUIET COMPONENTS OpenGL EGL)
foreach(package IN ITEMS benchmark CLI11 nlohmann_json)
  find_package(${package} QUIET)
  if(NOT ${package}_FOUND)
    string(APPEND VTKIBL_CANNOT_BENCHMARK "${package} is missing. ")
  endif()
endforeach()
foreach(module IN ITEMS ChartsCore FiltersGeneral IOExport RenderingContextOpenGL2 ViewsContext2D)
  if(NOT TARGET VTK::${module})
    string(APPEND VTKIBL_CANNOT_BENCHMARK "VTK::${module} is missing. ")
  endif()
endforeach()
if(NOT VTKIBL_CANNOT_BENCHMARK)
  set(VTKIBL_CAN_BENCHMARK ON)
endif()
