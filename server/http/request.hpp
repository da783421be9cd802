#pragma once

#include <any>

#include "base/clock.hpp"
#include "base/length.hpp"
#include "base/mapped_file.hpp"

namespace fitgauge::http {

/// The request methods of RFC 9110 that a route can name; every other token is `Other`.
enum class Method : std::uint8_t { Get, Head, Post, Put, Delete, Patch, Options, Other };

/// Returns `GET`, `HEAD`, …; empty for Other.
std::string_view name(Method method);

/// Parses a method, case-sensitively (RFC 9110 section 9.1).
Method method_named(std::string_view name);

struct RequestHead;
struct Route;

/// The other end of a connection.
struct Peer {
  std::string address;  ///< `127.0.0.1`, `::1`
  bool loopback = false;
  bool tls = false;
  bool health_only = false;  ///< came by the listener for the service's own health check
};

/// A parsed parameter: text and words as text, decimals as the integer value times 10^scale.
using ArgumentValue = std::variant<std::string_view, std::int64_t, Length, Timestamp>;

/// One request whose route is found and whose parameters are checked. Its views point to a head
/// that does not move while the body is read. They are valid until the request is answered; in an
/// asynchronous handler, as long as its Responder. Filled by the engine; one thread reads it at a
/// time.
class Request {
 public:
  Method method() const { return method_; }
  /// Returns the path as sent, not decoded: `/v1/limits/25%20H7`.
  std::string_view path() const { return path_; }
  /// Returns the text after the `?` as sent; empty if there is none.
  std::string_view query() const { return query_; }
  /// Returns the query as sent without this parameter; a `&` follows each other one.
  std::string query_without(std::string_view parameter) const;

  /// Returns the value of the first field with this name, case-insensitive.
  std::optional<std::string_view> header(std::string_view name) const;
  /// Returns all fields with this name, joined with ", " (RFC 9110 section 5.3).
  std::optional<std::string> header_list(std::string_view name) const;

  /// Return the argument of a parameter in path, query or header by its name; empty if an optional
  /// one is absent. Throws std::logic_error for an undeclared name or type.
  std::optional<std::string_view> text(std::string_view name) const;
  bool has(std::string_view name) const { return argument(name).has_value(); }
  std::optional<std::int64_t> integer(std::string_view name) const;  ///< Integer and Decimal
  std::optional<Length> length(std::string_view name) const;
  std::optional<Timestamp> time(std::string_view name) const;

  /// The decoded body, or empty. kBodyPadding bytes after its end are readable.
  std::string_view body() const { return body_.text; }
  /// Returns the decoded body; on disk if its route spools.
  const FileText& file_body() const { return body_; }
  static constexpr std::size_t kBodyPadding = 64;
  /// The body's media type in lower case without parameters; empty if none is named.
  std::string_view media_type() const { return media_type_; }
  /// Returns the media type, of those of the route's responses, that the client prefers.
  std::string_view response_type() const { return response_type_; }

  /// Appends a key for the response of a route without other inputs: the route, its parsed
  /// arguments, and the media type. Spellings of an argument share one key.
  void append_identity(std::string& out) const;

  /// Returns an id that is unique in this process and probably elsewhere.
  std::uint64_t id() const { return id_; }
  /// X-Request-Id if it is 1 to 64 of `[A-Za-z0-9._-]`, or id() as 16 hexadecimal digits.
  std::string_view id_text() const {
    return given_id_.empty() ? std::string_view(own_id_.data(), own_id_.size()) : given_id_;
  }

  std::string_view peer_address() const { return peer_->address; }  ///< `127.0.0.1`, `::1`
  /// Returns whether it has a field of a proxy: Forwarded, X-Forwarded-*, Via, X-Real-IP,
  /// True-Client-IP, CF-Connecting-IP.
  bool is_forwarded() const;
  /// Returns whether it comes from this machine: a loopback peer and no field of a proxy.
  bool is_local() const;
  bool is_http_1_0() const;
  /// Returns whether it came by the listener for health checks: see ListenAddress::health_only.
  bool is_health_only() const { return peer_->health_only; }
  /// Returns the origin that the client addressed, `https://host:port` or `http://…`, to compare
  /// with Origin. A proxy that ends TLS sets X-Forwarded-Proto; other sites cannot send it unasked.
  std::string own_origin() const;
  /// Returns the request's Origin if it is in ServerOptions::allowed_origins, or an empty text.
  std::string_view allowed_origin() const { return allowed_origin_; }
  /// Whether Accept-Encoding prefers gzip to no coding.
  bool prefers_gzip() const;

  /// Returns the matched route; null if the request was refused before the match.
  const Route* route() const { return route_; }

  /// Returns the sender as the guard stored it, or null.
  template <class T>
  const T* caller() const {
    return std::any_cast<T>(&caller_);
  }
  void set_caller(std::any caller) { caller_ = std::move(caller); }

 private:
  friend class Exchange;

  const std::optional<ArgumentValue>& argument(std::string_view name) const;
  template <class T>
  std::optional<T> argument_as(std::string_view name) const;

  Method method_ = Method::Other;
  std::uint64_t id_ = 0;
  std::array<char, 16> own_id_{};
  std::string_view given_id_;
  std::string_view allowed_origin_;
  const RequestHead* head_ = nullptr;
  const Peer* peer_ = nullptr;
  const Route* route_ = nullptr;
  std::string_view path_;
  std::string_view query_;
  FileText body_;
  std::string_view response_type_;
  std::string media_type_;
  std::vector<std::optional<ArgumentValue>> arguments_;  ///< parallel to the route's parameters
  std::any caller_;
};

}  // namespace fitgauge::http
