#pragma once

#include <vector>

#include "http/route.hpp"

namespace fitgauge::api {

/// The web page at / and the files it is made of below /web/.
void add_page_routes(std::vector<http::Route>& routes);

}  // namespace fitgauge::api
