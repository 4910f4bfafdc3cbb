# What the module links beside VTK, for this project and for the ParaView plugin's, which builds the same module against ParaView's VTK.
include("${CMAKE_CURRENT_LIST_DIR}/vtkIBLEmbedShaders.cmake")

find_package(OpenImageIO REQUIRED)
# Debian's libopenimageio-dev names OpenCV's headers without asking for them; a path that is not there is not needed.
foreach(target IN ITEMS OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
  get_target_property(includes ${target} INTERFACE_INCLUDE_DIRECTORIES)
  foreach(directory IN LISTS includes)
    if(NOT EXISTS "${directory}")
      list(REMOVE_ITEM includes "${directory}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${includes}")
endforeach()
find_package(OpenEXR REQUIRED)
find_package(glm REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS EGL)
find_package(Threads REQUIRED)
