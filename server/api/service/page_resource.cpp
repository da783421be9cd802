#include "api/resources.hpp"

#include "api/service/page_assets.hpp"

namespace fitgauge::api {
namespace {

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

Result<Response> answer(std::string_view path) {
  const std::string build = std::string(page_build()) + '/';
  const bool is_kept = path.starts_with(build);
  const std::string_view name = is_kept ? path.substr(build.size()) : path;
  const auto assets = page_assets();
  const auto found = std::ranges::find(assets, name, &PageAsset::path);
  if (found == assets.end())
    return Error{ErrorCode::NotFound, "the page has no file " + std::string(path)};
  const PageAsset& asset = *found;
  Response response(200, std::string(asset.content_type), bytes_of(asset.plain));
  response.with("Cache-Control", std::string(is_kept ? kKept : kFresh))
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
