# vtkibl_embed_shaders(FILE…): two outputs in the current binary directory.
#   vtkIBLShaderTexts.cxx   every FILE as a C++ string, so that nothing is read at run time
#   <name>Functions.inl     for each <name>Functions.glsl: the same text with `float` written `real` and each literal x written
#                           real(x), so that one text compiles as GLSL, as C++ float and as C++ double
# Run as a script (cmake -P) it does the work; included, it adds the rule.
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  set(texts "// Made by cmake/vtkIBLEmbedShaders.cmake from shaders/; do not edit.\n#include \"vtkIBLShaderTexts.h\"\n\n")
  string(APPEND texts "const vtkIBLShaderText vtkIBLShaderTexts[] = {\n")
  foreach(file IN LISTS SHADERS)
    get_filename_component(name "${file}" NAME)
    file(READ "${file}" text)
    string(REGEX MATCH "[^\t\r\n -~]" outside "${text}")
    if(outside)
      message(FATAL_ERROR "${file}: GLSL is ASCII; found '${outside}'")
    endif()
    string(APPEND texts "  { \"${name}\", R\"glsl(${text})glsl\" },\n")
    if(name MATCHES "Functions[.]glsl$")
      string(REGEX REPLACE "[.]glsl$" ".inl" inl "${name}")
      string(REGEX REPLACE "([^A-Za-z0-9_.])([0-9]+([.][0-9]*([eE][-+]?[0-9]+)?|[eE][-+]?[0-9]+))" "\\1real(\\2)" text "${text}")
      string(REGEX REPLACE "([^A-Za-z0-9_])float([^A-Za-z0-9_])" "\\1real\\2" text "${text}")
      file(CONFIGURE OUTPUT "${OUTPUT_DIRECTORY}/${inl}" CONTENT "${text}" @ONLY)
    endif()
  endforeach()
  string(APPEND texts "  { nullptr, nullptr },\n};\n")
  file(CONFIGURE OUTPUT "${OUTPUT_DIRECTORY}/vtkIBLShaderTexts.cxx" CONTENT "${texts}" @ONLY)
  file(TOUCH "${OUTPUT_DIRECTORY}/shaders.stamp")
  return()
endif()

set(vtkibl_embed_script "${CMAKE_CURRENT_LIST_FILE}")
function(vtkibl_embed_shaders)
  set(products "${CMAKE_CURRENT_BINARY_DIR}/vtkIBLShaderTexts.cxx")
  foreach(file IN LISTS ARGN)
    get_filename_component(name "${file}" NAME)
    if(name MATCHES "Functions[.]glsl$")
      string(REGEX REPLACE "[.]glsl$" ".inl" inl "${name}")
      list(APPEND products "${CMAKE_CURRENT_BINARY_DIR}/${inl}")
    endif()
  endforeach()
  # file(CONFIGURE) leaves unchanged products alone, so a comment in one shader does not rebuild the module; the stamp is
  # what tells the build tool that the rule ran.
  add_custom_command(
    OUTPUT "${CMAKE_CURRENT_BINARY_DIR}/shaders.stamp"
    BYPRODUCTS ${products}
    COMMAND "${CMAKE_COMMAND}" "-DSHADERS=${ARGN}" "-DOUTPUT_DIRECTORY=${CMAKE_CURRENT_BINARY_DIR}" -P "${vtkibl_embed_script}"
    DEPENDS ${ARGN} "${vtkibl_embed_script}"
    COMMENT "Embedding shaders" VERBATIM)
endfunction()
