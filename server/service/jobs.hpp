#pragma once

#include <cstddef>

#include "base/worker_pool.hpp"

namespace fitgauge::app {

/// The pools of the application, one for each kind of work that an I/O thread hands over.
struct Jobs {
  /// @param long_requests most bodies of measurements that wait
  explicit Jobs(std::size_t long_requests) : bulk("bulk", 2, long_requests) {}

  /// Work that ends in milliseconds: checks of programs, orders of runs, documents.
  JobPool orders{"orders", 2, 256};
  /// Work that the processor bounds: statistics, simulations, certificates.
  JobPool figures{"figures", 4, 64, JobBound{std::chrono::seconds(60), std::size_t{512} << 20}};
  /// Long bodies of measurements. One is stored at a time; the other has its first rows ready.
  JobPool bulk;
  /// Records that stations forward to this centre.
  JobPool intake{"intake", 2, 256};

  /// Refuses waiting orders and figures, and ends running figures; bodies run to their end.
  void call_off() {
    orders.call_off();
    figures.call_off();
  }
};

}  // namespace fitgauge::app
