#include "cli/http_client.hpp"

namespace fitgauge::cli {
namespace {

constexpr std::string_view kDrive = "TNC:\\";

/// Without the drive, with `/` between the folders.
std::string slashed(std::string_view path) {
  if (ascii_iequals(path.substr(0, kDrive.size() - 1), "TNC:"))
    path.remove_prefix(kDrive.size() - 1);
  std::string out(path);
  std::replace(out.begin(), out.end(), '\\', '/');
  return out.substr(std::min(out.find_first_not_of('/'), out.size()));
}

std::string_view host_of(std::string_view url) {
  url.remove_prefix(url.find("://") + 3);
  const std::string_view authority = url.substr(0, url.find('/'));
  if (authority.starts_with('[')) return authority.substr(0, authority.find(']') + 1);
  return authority.substr(0, authority.find(':'));
}

bool is_unreserved(char c) {
  return is_ascii_alphanumeric(c) || c == '-' || c == '.' || c == '_' || c == '~';
}

}  // namespace

Outcome<std::string> service_url(std::string_view text) {
  std::string url(trim(text));
  if (url.find("://") == std::string::npos) url.insert(0, "http://");
  while (url.ends_with('/')) url.pop_back();
  const bool known = url.starts_with("http://") || url.starts_with("https://");
  if (known && !host_of(url + '/').empty()) return url;
  return Failure::of(ExitCode::Usage,
                     "the address of the service must be such as http://127.0.0.1:8286; got '{}'",
                     text);
}

bool is_loopback(std::string_view url) {
  const std::string_view host = host_of(url);
  return host == "localhost" || host == "[::1]" || host.starts_with("127.");
}

std::string percent_encoded(std::string_view text, std::string_view kept) {
  std::string out;
  for (const char c : text) {
    if (is_unreserved(c) || kept.find(c) != std::string_view::npos) {
      out += c;
    } else {
      out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
    }
  }
  return out;
}

std::string file_target(std::string_view path) {
  std::string out = "/v1/files";
  const std::string rest = slashed(path);
  for (std::size_t begin = 0; begin <= rest.size();) {
    const std::size_t end = std::min(rest.find('/', begin), rest.size());
    out += '/' + percent_encoded(std::string_view(rest).substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

std::string control_path(std::string_view path) {
  std::string out = slashed(path);
  std::replace(out.begin(), out.end(), '/', '\\');
  return out.insert(0, kDrive);
}

std::string_view base_name(std::string_view path) {
  return path.substr(path.find_last_of("/\\") + 1);
}

}  // namespace fitgauge::cli
