# The page (clients/web), compiled in as esbuild bundles it with the libraries that package-lock.json pins; and the
# example programs of clients/nc, as examples/.

find_program(FITGAUGE_NODE NAMES node nodejs)
find_program(FITGAUGE_NPM npm)
if(NOT FITGAUGE_NODE OR NOT FITGAUGE_NPM)
  message(FATAL_ERROR
    "fitgauge needs node and npm to bundle its page: install them with "
    "`apt-get install nodejs npm`, or everything at once with scripts/install.")
endif()

set(page_root "${CMAKE_SOURCE_DIR}/clients/web")
set(page_packages "${CMAKE_BINARY_DIR}/web")
set(page_built "${page_packages}/page")
file(GLOB_RECURSE page_sources CONFIGURE_DEPENDS
     "${page_root}/*.html" "${page_root}/*.css" "${page_root}/*.js" "${page_root}/*.svg")

# Each package is what its SHA-512 says, whoever delivers it.
file(READ "${page_root}/package-lock.json" page_lock)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${page_root}/package-lock.json")
string(JSON page_package_count LENGTH "${page_lock}" packages)
math(EXPR page_last_package "${page_package_count} - 1")
foreach(i RANGE 1 ${page_last_package})  # the first is the page itself
  string(JSON page_package MEMBER "${page_lock}" packages ${i})
  string(JSON page_integrity ERROR_VARIABLE ignored GET "${page_lock}" packages "${page_package}" integrity)
  if(NOT page_integrity MATCHES "^sha512-")
    message(FATAL_ERROR
      "clients/web/package-lock.json does not pin ${page_package} by a SHA-512: remove the file and make it anew "
      "with `npm install --package-lock-only --omit-lockfile-registry-resolved` in a folder without node_modules.")
  endif()
endforeach()

# They come from npm's cache where it has them: without a network a filled cache is enough. What a proxy's
# certificate proves does not matter then: a network may end TLS with its own, unknown to the image being built.
add_custom_command(
  OUTPUT "${page_packages}/installed"
  COMMAND ${CMAKE_COMMAND} -E copy "${page_root}/package.json" "${page_root}/package-lock.json" "${page_packages}"
  COMMAND ${FITGAUGE_NPM} ci --prefix "${page_packages}" --prefer-offline --strict-ssl=false --ignore-scripts --no-audit --no-fund --loglevel=error
  COMMAND ${CMAKE_COMMAND} -E touch "${page_packages}/installed"
  DEPENDS "${page_root}/package.json" "${page_root}/package-lock.json"
  COMMENT "Fetching the libraries of the page"
  VERBATIM)

set(bundle_web "${CMAKE_SOURCE_DIR}/scripts/cmake/bundle_web.mjs")
add_custom_command(
  OUTPUT "${page_built}/index.html" "${page_built}/licences.txt"
  COMMAND ${FITGAUGE_NODE} "${bundle_web}" "${page_packages}" "${page_root}" "${page_built}"
  DEPENDS "${page_packages}/installed" ${page_sources} "${bundle_web}"
  COMMENT "Bundling the page"
  VERBATIM)

# The example programs, which the page puts on the control's disk.
set(page_examples "${CMAKE_SOURCE_DIR}/clients/nc")
file(GLOB example_files RELATIVE "${page_examples}" CONFIGURE_DEPENDS
     "${page_examples}/*/*.h" "${page_examples}/*/*.a" "${page_examples}/*/*.tab" "${page_examples}/*/setups/*.json")
set(example_sources ${example_files})
list(TRANSFORM example_sources PREPEND "${page_examples}/")
list(TRANSFORM example_files PREPEND "examples/")

set(embed_web "${CMAKE_SOURCE_DIR}/scripts/cmake/embed_web.cmake")
add_custom_command(
  OUTPUT page_assets.S page_assets.cpp
  COMMAND ${CMAKE_COMMAND} -D "OUT=${CMAKE_CURRENT_BINARY_DIR}"
          -D "PAGE=${page_built}" -D "EXAMPLES=${page_examples}" -D "EXAMPLE_FILES=${example_files}" -P "${embed_web}"
  DEPENDS "${page_built}/index.html" "${page_built}/licences.txt" ${example_sources} "${embed_web}"
  COMMENT "Embedding the page"
  VERBATIM)
