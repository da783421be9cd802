#pragma once

#include "base/worker_pool.hpp"

namespace fitgauge::app {

/// The pools of the application, one for each kind of work that an I/O thread hands over.
struct Jobs {
  /// @param long_requests most bodies of measurements that wait
  explicit Jobs(std::size_t long_requests) : bulk("bulk", 2, long_requests) {}

  /// Work that ends in milliseconds: checks of programs, orders of runs, documents.
  JobPool orders{"orders", 2, 256};
  static constexpr JobBound kOfFigure{std::chrono::seconds(60), std::size_t{512} << 20};
  /// Work that the processor bounds: statistics, simulations, certificates.
  JobPool figures{"figures", 4, 64, kOfFigure};
  /// Figures of long bodies, one at a time: their values and their answer take most of the memory.
  JobPool long_figures{"long figures", 1, 64, kOfFigure};
  JobPool& figures_of(std::size_t body_bytes) {
    constexpr std::size_t kLong = std::size_t{64} << 10;
    return body_bytes > kLong ? long_figures : figures;
  }
  /// Long bodies of measurements. One is stored at a time; the other has its first rows ready.
  JobPool bulk;
  /// Records that stations forward to this centre.
  JobPool intake{"intake", 2, 256};

  /// Refuses waiting orders and figures, and ends running figures; bodies run to their end.
  void call_off() {
    orders.call_off();
    figures.call_off();
    long_figures.call_off();
  }
};

}  // namespace fitgauge::app
