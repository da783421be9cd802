# cmake -DOUT=<folder> -DPAGE=<folder> -DEXAMPLES=<folder> -DEXAMPLE_FILES=<names> -P embed_web.cmake
# Writes OUT/page_assets.S, which has the bytes, and OUT/page_assets.cpp, the table of server/api/service/page_assets.hpp:
# every file of PAGE, and the example files as examples/, as it is and gzipped, with its media type and an entity tag made
# of its content. index.html names the other files below the build's name, a digest of them all: what stands there never
# changes and may be kept for ever.

set(type_html "text/html; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(type_svg "image/svg+xml")
set(type_txt "text/plain; charset=utf-8")
set(type_h "${type_txt}")
set(type_a "${type_txt}")
set(type_tab "${type_txt}")
set(type_json "${type_txt}")

file(GLOB_RECURSE FILES RELATIVE "${PAGE}" "${PAGE}/*")
foreach(name IN LISTS EXAMPLE_FILES)
  string(REGEX REPLACE "^examples/" "" from "${name}")
  set("source_${name}" "${EXAMPLES}/${from}")
endforeach()
foreach(name IN LISTS FILES)
  set("source_${name}" "${PAGE}/${name}")
endforeach()
list(APPEND FILES ${EXAMPLE_FILES})

set(digests "")
foreach(name IN LISTS FILES)
  file(SHA256 "${source_${name}}" digest)
  string(APPEND digests "${name} ${digest}\n")
endforeach()
string(SHA256 build "${digests}")
string(SUBSTRING "${build}" 0 12 build)

# Adds the bytes of a file to the object, and the array that the table sees of them.
macro(embed file array)
  file(SIZE "${file}" size)
  string(APPEND bytes "  .global ${array}\n${array}:\n  .incbin \"${file}\"\n")
  string(APPEND arrays "extern const unsigned char ${array}[${size}];\n")
endmacro()

set(bytes "")
set(arrays "")
set(rows "")
file(MAKE_DIRECTORY "${OUT}/page")
set(number 0)
foreach(name IN LISTS FILES)
  string(REGEX REPLACE ".*\\." "" extension "${name}")
  if(NOT DEFINED type_${extension})
    message(FATAL_ERROR "embed_web: no media type is known for ${name}")
  endif()
  set(source "${source_${name}}")
  if(name STREQUAL "index.html")
    file(READ "${source}" text)
    string(REPLACE "\"/web/" "\"/web/${build}/" text "${text}")
    set(source "${OUT}/page/index.html")
    file(WRITE "${source}" "${text}")
  endif()
  set(packed "${OUT}/page/${number}.gz")
  execute_process(COMMAND gzip -9 -n -c "${source}" OUTPUT_FILE "${packed}"
                  COMMAND_ERROR_IS_FATAL ANY)
  file(SHA256 "${source}" digest)
  string(SUBSTRING "${digest}" 0 16 digest)
  embed("${source}" fitgauge_page_${number})
  embed("${packed}" fitgauge_page_${number}_gz)
  string(APPEND rows
    "    {\"${name}\", \"${type_${extension}}\", \"${digest}\", fitgauge_page_${number}, fitgauge_page_${number}_gz},\n")
  math(EXPR number "${number} + 1")
endforeach()

file(WRITE "${OUT}/page_assets.S"
"  .section .rodata\n${bytes}  .section .note.GNU-stack, \"\", %progbits\n")

file(WRITE "${OUT}/page_assets.cpp"
"#include \"api/service/page_assets.hpp\"\n
extern \"C\" {
${arrays}}\n
namespace fitgauge::api {
namespace {\n
constexpr PageAsset kAssets[] = {
${rows}};\n
}  // namespace\n
std::span<const PageAsset> page_assets() { return kAssets; }\n
std::string_view page_build() { return \"${build}\"; }\n
}  // namespace fitgauge::api\n")
