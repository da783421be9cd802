#include "http/route.hpp"

#include <utility>

#include "http/engine/route_tree.hpp"

namespace fitgauge::http {

RouteTable::RouteTable(std::vector<Route> routes)
    : routes_(std::move(routes)), tree_(std::make_unique<const RouteTree>(routes_)) {}
RouteTable::RouteTable(RouteTable&&) noexcept = default;
RouteTable& RouteTable::operator=(RouteTable&&) noexcept = default;
RouteTable::~RouteTable() = default;

}  // namespace fitgauge::http
