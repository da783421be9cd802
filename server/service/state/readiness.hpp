#pragma once

namespace fitgauge::app {

/// Whether the service may be used, and the activity of the database.
struct Readiness {
  std::vector<Error> findings;  ///< empty: ready
  std::string database;         ///< `ok`, or `checking` while a large file is still being read
};

}  // namespace fitgauge::app
