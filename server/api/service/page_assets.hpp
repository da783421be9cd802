#pragma once

namespace fitgauge::api {

/// One file of the page (clients/web), compiled in.
struct PageAsset {
  std::string_view path;  ///< below clients/web: `views/gauge.js`
  std::string_view content_type;
  std::string_view digest;  ///< of the content, for its entity tag
  std::span<const unsigned char> plain;
  std::span<const unsigned char> gzipped;
};

/// Every file of the page; written by scripts/cmake/embed_web.cmake.
std::span<const PageAsset> page_assets();

/// Returns a name for all files together, which changes as soon as one of them does.
std::string_view page_build();

}  // namespace fitgauge::api
