#include "http/engine/exchange.hpp"

namespace fitgauge::http {
namespace {

/// By ParameterPlace: its words, and the code of a bad value.
constexpr std::pair<std::string_view, ErrorCode> kPlaces[] = {
    {"path segment", ErrorCode::PathMalformed},
    {"query parameter", ErrorCode::QueryInvalid},
    {"header field", ErrorCode::RequestMalformed}};

/// A time that begins or ends a range may be outside of the range of a Timestamp.
Result<Timestamp> parse_time(std::string_view text) {
  auto time = parse_rfc3339(text);
  const std::string_view year = text.substr(0, 4);
  if (time || year.find_first_not_of("0123456789") != std::string_view::npos) return time;
  // All but the year is read as in one with every date.
  std::string in_leap_year(text);
  const auto far = parse_rfc3339(in_leap_year.replace(0, year.size(), "2000"));
  using Nanoseconds = std::numeric_limits<std::int64_t>;
  if (far && year < "1678") return Timestamp{Nanoseconds::min()};
  if (far && year > "2261") return Timestamp{Nanoseconds::max()};
  return time;
}

/// One reader per kind of parameter.
struct Reader {
  const Parameter& parameter;
  std::string_view text;

  const std::pair<std::string_view, ErrorCode>& place() const {
    return kPlaces[static_cast<std::size_t>(parameter.place)];
  }
  Error refuse(const std::string& expected) const {
    const auto& [words, code] = place();
    return {code, fmt::format("{} {} must be {}", words, parameter.name, expected), parameter.name};
  }

  Result<ArgumentValue> operator()(const Text& type) const {
    if (text.size() > type.max_length)
      return refuse(fmt::format("at most {} bytes long", type.max_length));
    return ArgumentValue(text);
  }

  Result<ArgumentValue> operator()(const Integer& type) const {
    const auto value = read_number<std::int64_t>(text);
    if (!value || *value < type.min || *value > type.max)
      return refuse(fmt::format("a whole number from {} to {}", type.min, type.max));
    return ArgumentValue(*value);
  }

  Result<ArgumentValue> operator()(const Decimal& type) const {
    const auto value = parse_decimal(text, {.scale = type.scale, .decimal_comma = true});
    if (!value || *value < type.min || *value > type.max) {
      return refuse(fmt::format("a decimal number from {} to {} with at most {} decimals",
                                format_decimal(type.min, type.scale),
                                format_decimal(type.max, type.scale), type.scale));
    }
    return ArgumentValue(*value);
  }

  Result<ArgumentValue> operator()(const LengthIn& type) const {
    const DecimalSyntax syntax{.decimal_comma = true, .round_to_nearest = type.round_to_nearest};
    auto length = type.unit == LengthUnit::Millimetre ? parse_length_mm(text, syntax)
                                                      : parse_length_um(text, syntax);
    if (!length) {
      Error error = std::move(length).error();
      if (error.code == ErrorCode::LengthOutOfRange) error.code = type.too_long;
      error.message = fmt::format("The {} {}: {}", place().first, parameter.name, error.message);
      error.where = parameter.name;
      return error;
    }
    return ArgumentValue(*length);
  }

  Result<ArgumentValue> operator()(const Words& type) const {
    const auto found = std::ranges::find(type.words, text);
    if (found == type.words.end())
      return refuse(fmt::format("one of: {}", fmt::join(type.words, ", ")));
    return ArgumentValue(std::string_view(*found));
  }

  Result<ArgumentValue> operator()(const Time&) const {
    auto time = parse_time(text);
    if (!time && parameter.place == ParameterPlace::Query) {
      // The + of an offset that was not percent-encoded arrives as a blank.
      std::string signed_offset(text);
      std::ranges::replace(signed_offset, ' ', '+');
      time = parse_time(signed_offset);
    }
    if (!time) return refuse("a time as in RFC 3339, 2026-11-20T08:00:00Z");
    return ArgumentValue(*time);
  }
};

}  // namespace

bool split_path(std::string_view path, std::string& decoded, PathSegments& out) {
  if (!path.starts_with('/')) return false;
  path.remove_prefix(1);
  bool plain = true;
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (path[i] == '/') out.end_segment(i + 1);
    plain &= is_plain(path[i]);
  }
  out.end_segment(path.size() + 1);
  out.path_ = path;
  if (plain) return true;

  out = {};
  const std::size_t start = decoded.size();
  for (bool more = true; more;) {
    const std::size_t slash = path.find('/');
    more = slash != std::string_view::npos;
    if (!append_percent_decoded(decoded, path.substr(0, slash), false)) return false;
    if (more) {
      decoded.push_back('/');
      path.remove_prefix(slash + 1);
    }
    out.end_segment(decoded.size() - start + (more ? 0 : 1));
  }
  out.path_ = std::string_view(decoded).substr(start);
  return true;
}

std::int16_t Resource::route(Method method) const {
  if (method == Method::Other) return kNone;
  const std::int16_t own = routes[static_cast<std::size_t>(method)];
  return own == kNone && method == Method::Head ? routes[static_cast<std::size_t>(Method::Get)]
                                                : own;
}

std::string Resource::allow() const {
  std::string text;
  for (std::size_t i = 0; i < routes.size(); ++i) {
    const auto method = static_cast<Method>(i);
    if (route(method) == kNone && method != Method::Options) continue;
    if (!text.empty()) text += ", ";
    text += name(method);
  }
  return text;
}

RouteTree::RouteTree(std::vector<Route>& routes) : plans_(routes.size()) {
  for (std::size_t i = 0; i < routes.size(); ++i) add(routes[i], static_cast<std::int16_t>(i));
}

void RouteTree::add(Route& route, std::int16_t index) {
  const auto fail = [&](std::string_view why) {
    throw std::logic_error(fmt::format("route {} {}: {}", name(route.method), route.pattern, why));
  };
  Plan& plan = plans_[static_cast<std::size_t>(index)];
  std::size_t depth = 0;
  const auto capture = [&](std::string_view parameter, bool takes_rest) {
    auto found = std::ranges::find_if(route.parameters, [&](const Parameter& candidate) {
      return candidate.place == ParameterPlace::Path && candidate.name == parameter;
    });
    if (found == route.parameters.end()) {
      found = route.parameters.insert(
          found, Parameter{.name = std::string(parameter), .place = ParameterPlace::Path});
    }
    found->required = true;
    plan.captures.push_back(
        {.parameter = static_cast<std::size_t>(found - route.parameters.begin()),
         .segment = depth,
         .takes_rest = takes_rest});
  };

  if (route.method == Method::Other) fail("has no method");
  if (!route.pattern.starts_with('/')) fail("does not begin with a slash");
  Node* node = &root_;
  std::string_view pattern = std::string_view(route.pattern).substr(1);
  for (bool more = true; more; ++depth) {
    const std::size_t slash = pattern.find('/');
    const std::string_view segment = pattern.substr(0, slash);
    more = slash != std::string_view::npos;
    if (more) pattern.remove_prefix(slash + 1);
    std::unique_ptr<Node>* next = nullptr;
    if (segment.starts_with('{') && segment.ends_with("*}")) {
      if (more) fail("has a segment after the rest of the path");
      capture(segment.substr(1, segment.size() - 3), true);
      next = &node->rest;
    } else if (segment.starts_with('{') && segment.ends_with('}')) {
      capture(segment.substr(1, segment.size() - 2), false);
      next = &node->parameter;
    } else if (segment.find_first_of("{}") != std::string_view::npos) {
      fail("has a parameter that is not a whole segment");
    } else {
      auto found = std::ranges::find_if(
          node->literals, [&](const auto& literal) { return literal.first == segment; });
      if (found == node->literals.end()) found = node->literals.emplace(found, segment, nullptr);
      next = &found->second;
    }
    if (!*next) *next = std::make_unique<Node>();
    node = next->get();
  }

  std::int16_t& slot = node->resource.routes[static_cast<std::size_t>(route.method)];
  if (slot != Resource::kNone) fail("is repeated");
  slot = index;
  node->is_resource = true;
  for (const Parameter& parameter : route.parameters) {
    plan.has_query |= parameter.place == ParameterPlace::Query;
    plan.has_headers |= parameter.place == ParameterPlace::Header;
  }
  const auto path_parameters = std::ranges::count_if(
      route.parameters, [](const Parameter& each) { return each.place == ParameterPlace::Path; });
  if (static_cast<std::size_t>(path_parameters) != plan.captures.size())
    fail("declares a path parameter that the pattern does not have");
}

const Resource* RouteTree::descend(const Node& node, const PathSegments& path, std::size_t depth) {
  if (depth == path.count())
    return node.is_resource && !path.is_longer() ? &node.resource : nullptr;
  const std::string_view segment = path.segment(depth);
  for (const auto& [text, child] : node.literals) {
    if (text != segment) continue;
    if (const Resource* found = descend(*child, path, depth + 1)) return found;
  }
  if (node.parameter && !segment.empty()) {
    if (const Resource* found = descend(*node.parameter, path, depth + 1)) return found;
  }
  return node.rest && !path.rest(depth).empty() ? &node.rest->resource : nullptr;
}

Result<ArgumentValue> parse_argument(const Parameter& parameter, std::string_view text) {
  return std::visit(Reader{parameter, text}, parameter.type);
}

RouteTable::RouteTable(std::vector<Route> routes)
    : routes_(std::move(routes)), tree_(std::make_unique<const RouteTree>(routes_)) {}
RouteTable::RouteTable(RouteTable&&) noexcept = default;
RouteTable& RouteTable::operator=(RouteTable&&) noexcept = default;
RouteTable::~RouteTable() = default;

}  // namespace fitgauge::http
