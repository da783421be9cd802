#include "http/engine/route_tree.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "http/engine/uri.hpp"

namespace fitgauge::http {

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
    auto found = std::find_if(
        route.parameters.begin(), route.parameters.end(), [&](const Parameter& candidate) {
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
      if (more) fail("goes on after the rest of the path");
      capture(segment.substr(1, segment.size() - 3), true);
      next = &node->rest;
    } else if (segment.starts_with('{') && segment.ends_with('}')) {
      capture(segment.substr(1, segment.size() - 2), false);
      next = &node->parameter;
    } else if (segment.find_first_of("{}") != std::string_view::npos) {
      fail("has a parameter that is not a whole segment");
    } else {
      auto found = std::find_if(node->literals.begin(), node->literals.end(),
                                [&](const auto& literal) { return literal.first == segment; });
      if (found == node->literals.end()) {
        found = node->literals.emplace(found, segment, nullptr);
      }
      next = &found->second;
    }
    if (!*next) *next = std::make_unique<Node>();
    node = next->get();
  }

  std::int16_t& slot = node->resource.routes[static_cast<std::size_t>(route.method)];
  if (slot != Resource::kNone) fail("is there twice");
  slot = index;
  node->is_resource = true;
  for (const Parameter& parameter : route.parameters) {
    plan.has_query |= parameter.place == ParameterPlace::Query;
    plan.has_headers |= parameter.place == ParameterPlace::Header;
  }
  const auto path_parameters =
      std::count_if(route.parameters.begin(), route.parameters.end(),
                    [](const Parameter& each) { return each.place == ParameterPlace::Path; });
  if (static_cast<std::size_t>(path_parameters) != plan.captures.size()) {
    fail("declares a path parameter that the pattern does not have");
  }
}

const Resource* RouteTree::descend(const Node& node, const PathSegments& path, std::size_t depth) {
  if (depth == path.count()) {
    return node.is_resource && !path.is_longer() ? &node.resource : nullptr;
  }
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

}  // namespace fitgauge::http
