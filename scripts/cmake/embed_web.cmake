# cmake -DOUT=<file> -DROOT=<folder> -DBUNDLED=<folder> -DFILES=<names> -P embed_web.cmake
# Writes the table of server/api/service/page_assets.hpp: every file of the page as it is and gzipped, with its
# media type and an entity tag made of its content. index.html names the other files below the build's name,
# a digest of them all: what stands there never changes and may be kept for ever. Names below bundled/ are taken
# from BUNDLED, all others from ROOT.

set(type_html "text/html; charset=utf-8")
set(type_css "text/css; charset=utf-8")
set(type_js "text/javascript; charset=utf-8")
set(type_svg "image/svg+xml")
set(type_txt "text/plain; charset=utf-8")

# The bytes of a file as the initialiser of an array.
function(bytes_of file variable)
  file(READ "${file}" hex HEX)
  string(REGEX REPLACE "(................................)" "\\1\n" hex "${hex}")
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "0x\\1," hex "${hex}")
  set(${variable} "${hex}" PARENT_SCOPE)
endfunction()

# Where the bytes of a file of the page are.
function(source_of name variable)
  set(root "${ROOT}")
  if(name MATCHES "^bundled/")
    set(root "${BUNDLED}")
  endif()
  set(${variable} "${root}/${name}" PARENT_SCOPE)
endfunction()

set(digests "")
foreach(name IN LISTS FILES)
  source_of("${name}" source)
  file(SHA256 "${source}" digest)
  string(APPEND digests "${name} ${digest}\n")
endforeach()
string(SHA256 build "${digests}")
string(SUBSTRING "${build}" 0 12 build)

set(arrays "")
set(rows "")
set(number 0)
foreach(name IN LISTS FILES)
  string(REGEX REPLACE ".*\\." "" extension "${name}")
  if(NOT DEFINED type_${extension})
    message(FATAL_ERROR "embed_web: no media type is known for ${name}")
  endif()
  source_of("${name}" source)
  if(name STREQUAL "index.html")
    file(READ "${source}" text)
    string(REPLACE "\"/web/" "\"/web/${build}/" text "${text}")
    set(source "${OUT}.html")
    file(WRITE "${source}" "${text}")
  endif()
  set(packed "${OUT}.gz")
  execute_process(COMMAND gzip -9 -n -c "${source}" OUTPUT_FILE "${packed}"
                  COMMAND_ERROR_IS_FATAL ANY)
  file(SHA256 "${source}" digest)
  string(SUBSTRING "${digest}" 0 16 digest)
  bytes_of("${source}" plain)
  bytes_of("${packed}" gzipped)
  file(REMOVE "${packed}")
  string(APPEND arrays
    "constexpr unsigned char kPlain${number}[] = {\n${plain}};\n"
    "constexpr unsigned char kGzipped${number}[] = {\n${gzipped}};\n")
  string(APPEND rows
    "    {\"${name}\", \"${type_${extension}}\", \"${digest}\", kPlain${number}, kGzipped${number}},\n")
  math(EXPR number "${number} + 1")
endforeach()

file(WRITE "${OUT}"
"#include \"api/service/page_assets.hpp\"\n
namespace fitgauge::api {
namespace {\n
${arrays}
constexpr PageAsset kAssets[] = {
${rows}};\n
}  // namespace\n
std::span<const PageAsset> page_assets() { return kAssets; }\n
std::string_view page_build() { return \"${build}\"; }\n
}  // namespace fitgauge::api\n")
