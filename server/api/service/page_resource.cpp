#include "api/resources.hpp"

#include "api/service/page_assets.hpp"

namespace fitgauge::api {
namespace {

/// A file as one of its addresses serves it.
struct Served {
  const PageAsset& asset;
  std::string_view caching;
};

constexpr std::string_view kEntry = "index.html";

/// The page loads nothing from other sites, runs only its scripts, and no other site frames it.
constexpr std::string_view kPolicy =
    "default-src 'self'; object-src 'none'; base-uri 'none'; form-action 'none'; "
    "frame-ancestors 'none'";

/// Revalidated each time, or cached: files below the build's name never change.
constexpr std::string_view kFresh = "no-cache";
constexpr std::string_view kKept = "public, max-age=31536000, immutable";

std::string bytes_of(std::span<const unsigned char> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

std::map<std::string, Served, std::less<>> page_files() {
  std::map<std::string, Served, std::less<>> files;
  for (const PageAsset& asset : page_assets()) {
    const std::string path(asset.path);
    files.emplace(path, Served{asset, kFresh});
    files.emplace(std::string(page_build()) + '/' + path, Served{asset, kKept});
  }
  return files;
}

Result<Response> answer(std::string_view path) {
  static const auto files = page_files();
  const auto found = files.find(path);
  if (found == files.end())
    return Error{ErrorCode::NotFound, "the page has no file " + std::string(path)};
  const auto& [asset, caching] = found->second;
  Response response(200, std::string(asset.content_type), bytes_of(asset.plain));
  response.with("Cache-Control", std::string(caching))
      .with("Content-Security-Policy", std::string(kPolicy))
      .with("Referrer-Policy", "no-referrer")
      .with("Service-Worker-Allowed", "/");
  response.etag = '"' + std::string(asset.digest) + '"';
  return Response(http::prepare(response, bytes_of(asset.gzipped)));
}

}  // namespace

void add_page_routes(Routes& add) {
  add("GET / getPage open", [](const Request&) { return answer(kEntry); },
      {.summary = "The page", .response_types = {"text/html"}, .outcomes = {{.meaning = "HTML"}}});
  add("GET /web/{path*} getPageFile open 404",
      [](const Request& request) { return answer(*request.text("path")); },
      {.summary = "A file of the page",
       .parameters = {path_parameter("path", "app.js")},
       .response_types = {},
       .outcomes = {{.meaning = "Bytes of the file",
                     .media_types = {"text/html", "text/css", "text/javascript", "image/svg+xml",
                                     "text/plain"}}}});
}

}  // namespace fitgauge::api
