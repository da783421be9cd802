#include "api/resources.hpp"

#include "api/service/page_assets.hpp"

namespace fitgauge::api {
namespace {

using Prepared = std::shared_ptr<const http::PreparedResponse>;

using PageFiles = std::map<std::string, Prepared, std::less<>>;

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

Prepared prepare_file(const PageAsset& asset, std::string_view caching) {
  Response response(200, std::string(asset.content_type), bytes_of(asset.plain));
  response.with("Cache-Control", std::string(caching))
      .with("Content-Security-Policy", std::string(kPolicy))
      .with("Referrer-Policy", "no-referrer")
      .with("Service-Worker-Allowed", "/");
  response.etag = '"' + std::string(asset.digest) + '"';
  return http::prepare(response, bytes_of(asset.gzipped));
}

PageFiles prepare_files() {
  PageFiles files;
  for (const PageAsset& asset : page_assets()) {
    const std::string path(asset.path);
    files.emplace(path, prepare_file(asset, kFresh));
    files.emplace(std::string(page_build()) + '/' + path, prepare_file(asset, kKept));
  }
  return files;
}

Result<Response> answer(const PageFiles& files, std::string_view path) {
  const auto found = files.find(path);
  if (found == files.end())
    return Error{ErrorCode::NotFound, "the page has no file " + std::string(path)};
  return Response(found->second);
}

}  // namespace

void add_page_routes(Routes& add) {
  const auto files = std::make_shared<const PageFiles>(prepare_files());
  add("GET / getPage open", [files](const Request&) { return answer(*files, kEntry); },
      {.summary = "The page", .response_types = {"text/html"}, .outcomes = {{.meaning = "HTML"}}});
  add("GET /web/{path*} getPageFile open 404",
      [files](const Request& request) { return answer(*files, *request.text("path")); },
      {.summary = "A file of the page",
       .parameters = {path_parameter("path", "app.js")},
       .response_types = {},
       .outcomes = {{.meaning = "Bytes of the file",
                     .media_types = {"text/html", "text/css", "text/javascript", "image/svg+xml",
                                     "text/plain"}}}});
}

}  // namespace fitgauge::api
