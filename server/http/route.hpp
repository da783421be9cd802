#pragma once

#include "http/request.hpp"
#include "http/response.hpp"

namespace fitgauge::http {

class RouteTree;

// Types of a parameter. Every type is checked before the handler runs. The error of a refused path
// or query value names the parameter and the accepted values.

struct Text {
  std::size_t max_length = 1024;  ///< bytes after decoding; may be empty in a query
  std::string_view schema{};      ///< for the API's description: what the handler checks
};
struct Integer {
  std::int64_t min = std::numeric_limits<std::int64_t>::min();
  std::int64_t max = std::numeric_limits<std::int64_t>::max();
};
/// A decimal number, with a point or a comma, read as value times 10^scale. The range is in scaled
/// integers.
struct Decimal {
  int scale = 6;
  std::int64_t min = std::numeric_limits<std::int64_t>::min();
  std::int64_t max = std::numeric_limits<std::int64_t>::max();
};
enum class LengthUnit : std::uint8_t { Millimetre, Micrometre };
/// A length; a decimal comma is accepted. Refused with the codes of base/length.hpp, or `too_long`.
struct LengthIn {
  LengthUnit unit = LengthUnit::Millimetre;
  bool round_to_nearest = false;  ///< measured values: to the nearest nanometre instead of refused
  ErrorCode too_long = ErrorCode::LengthOutOfRange;
};
struct Words {
  std::vector<std::string> words;
};
/// RFC 3339.
struct Time {};

using ParameterType = std::variant<Text, Integer, Decimal, LengthIn, Words, Time>;

enum class ParameterPlace : std::uint8_t { Path, Query, Header };

struct Parameter {
  std::string name;
  ParameterPlace place = ParameterPlace::Query;
  ParameterType type = Text{};
  bool required = false;  ///< a path parameter always is
  std::string description{};
  bool replaces_accept = false;  ///< its argument names the form of the response
};

enum class BodyUse : std::uint8_t {
  None,      ///< a body is read and discarded
  Optional,  ///< may be absent; its media type is checked when there is one
  Required,  ///< 411 without a length, 415 without one of the route's media types
};

struct BodyRules {
  BodyUse use = BodyUse::None;
  /// Lower case, without parameters; empty accepts any or none. Charset may only be UTF-8.
  std::vector<std::string> media_types{};
  std::size_t limit = std::size_t{1} << 20;  ///< bytes, after decompression
  std::string other_type{};                  ///< a media type with another limit
  std::size_t other_limit = 0;               ///< the limit of this type
  bool spools = false;                       ///< above 1 MiB on disk: Request::file_body()
  std::string when_too_large{};              ///< remedy, after "…: "
  std::string schema{};                      ///< of its JSON form, by name

  std::size_t limit_of(std::string_view media_type) const {
    return !other_type.empty() && media_type == other_type ? other_limit : limit;
  }
};

/// A success of a route, for the API's description.
struct Outcome {
  int status = 200;
  std::string meaning{};
  std::string schema{};  ///< of its JSON form, by name
  /// Empty: the types of the route if there is a schema or the status is 200; otherwise no body.
  std::vector<std::string> media_types{};
};

/// Handlers return an expected failure; the error formatter makes the response.
using SyncHandler = std::function<Result<Response>(const Request&)>;
using AsyncHandler = std::function<void(const Request&, Responder)>;
/// Answers a request at once, and in one write with those before, unless it has to wait.
struct EitherHandler {
  std::function<bool(const Request&)> has_to_wait;
  SyncHandler now;
  AsyncHandler later;
};
/// Handlers run on an I/O thread and must not block. Long work goes to a worker with its Responder.
using Handler = std::variant<SyncHandler, AsyncHandler, EitherHandler>;

/// One operation as data: dispatch, validation, error texts and the API's description come from it.
/// GET also answers HEAD; OPTIONS and 405 are derived.
struct Route {
  Method method = Method::Get;
  /// `/v1/fits/{hole}/{shaft}`. The last segment may be `{path*}`: the rest of the path, at least
  /// one character, with encoded slashes as slashes. A literal segment precedes a parameter.
  std::string pattern{};
  Handler handler{};
  std::string summary{};
  std::string description{};
  /// Path parameters may be omitted here: they are then required text.
  std::vector<Parameter> parameters{};
  BodyRules body{};
  /// Types for Accept: the first is the default; if none is acceptable, 406. Empty skips the check.
  std::vector<std::string> response_types{"application/json"};
  std::string access{};        ///< required access, for the guard; the engine does not read it
  std::string query_access{};  ///< required access of a request with a query; empty: like access
  // Only for the API's description:
  std::string operation{};          ///< the operation's name in generated clients: `getLimits`
  std::string tag{};                ///< group of operations
  std::vector<Outcome> outcomes{};  ///< every success
  /// Refusals in addition to those of parameters, body and access: 404, 409, 412, 422, 503.
  std::vector<int> refusals{};
};

/// Routes and their index. Immutable after construction; every I/O thread reads it.
class RouteTable {
 public:
  /// @throws std::logic_error for a malformed pattern, two routes of one method and shape, or a
  ///   path parameter that the pattern does not have.
  explicit RouteTable(std::vector<Route> routes);
  RouteTable(RouteTable&&) noexcept;
  RouteTable& operator=(RouteTable&&) noexcept;
  ~RouteTable();

  const std::vector<Route>& routes() const { return routes_; }
  const RouteTree& tree() const { return *tree_; }  ///< the engine's index

 private:
  std::vector<Route> routes_;
  std::unique_ptr<const RouteTree> tree_;
};

}  // namespace fitgauge::http
