# The report's page, style, scripts and the plotting library, compiled into the program so that
# every report is one self-contained file. Run by CMake in script mode (-P) this file writes the
# C++ source that holds them; included, it says how and when that happens.

if(CMAKE_SCRIPT_MODE_FILE)
  set(arrays "")
  set(branches "")
  set(index 0)
  foreach(asset IN LISTS ASSETS)
    get_filename_component(name "${asset}" NAME)
    file(READ "${asset}" bytes HEX)
    # Bytes rather than string literals, whose length compilers limit.
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(REGEX REPLACE "(0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,0x..,)" "\\1\n"
           bytes "${bytes}")
    string(APPEND arrays "const unsigned char asset_${index}[] = {\n${bytes}};\n")
    string(APPEND branches "  if (file_name == \"${name}\") return text(asset_${index});\n")
    math(EXPR index "${index} + 1")
  endforeach()
  file(WRITE "${OUTPUT}" "\
#include \"flexura/report/assets.hpp\"

#include <cstddef>

namespace flexura {
namespace {

${arrays}
template <std::size_t size>
std::string_view text(const unsigned char (&bytes)[size]) {
  return {reinterpret_cast<const char*>(bytes), size};
}

}  // namespace

std::string_view report_asset(std::string_view file_name) {
${branches}  return {};
}

}  // namespace flexura
")
  return()
endif()

find_file(FLEXURA_D3 d3.min.js PATHS /usr/share/nodejs/d3/dist NO_DEFAULT_PATH
          DOC "D3 version 5, minified, for the HTML report")
if(NOT FLEXURA_D3)
  message(FATAL_ERROR "D3 was not found at /usr/share/nodejs/d3/dist/d3.min.js: install the "
                      "Debian package node-d3, or set FLEXURA_D3 to a d3.min.js of version 5.")
endif()

set(page_folder ${CMAKE_CURRENT_SOURCE_DIR}/flexura/report/page)
file(GLOB report_page CONFIGURE_DEPENDS ${page_folder}/*.html ${page_folder}/*.css
     ${page_folder}/*.js ${page_folder}/*.txt)
set(report_assets ${report_page} ${FLEXURA_D3})
set(report_assets_source ${CMAKE_CURRENT_BINARY_DIR}/report_assets.cpp)
add_custom_command(
  OUTPUT ${report_assets_source}
  COMMAND ${CMAKE_COMMAND} "-DASSETS=${report_assets}" -DOUTPUT=${report_assets_source}
          -P ${CMAKE_CURRENT_LIST_FILE}
  DEPENDS ${report_assets} ${CMAKE_CURRENT_LIST_FILE}
  COMMENT "Embedding the report's page" VERBATIM)
set_source_files_properties(${report_assets_source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)

# Its source becomes part of whoever links to it: the library stays one archive.
add_library(flexura_report_assets INTERFACE)
target_sources(flexura_report_assets INTERFACE ${report_assets_source})
