#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "plant/centre/centre_link.hpp"
#include "service/revisions/revision_intake.hpp"

namespace fitgauge::forwarder {

/// Asks the centre every few seconds what it hands on, and takes it. What it was last answered is
/// known to it alone: after a start it takes all again, which changes nothing. For one thread.
class Follower {
 public:
  /// @param tell the event's name and a sentence, for the log of the service.
  /// @param station what the ids of this folder end with, when it is asked.
  Follower(app::RevisionIntake intake, std::function<std::string_view()> station,
           std::function<void(std::string_view event, const std::string& detail)> tell)
      : intake_(std::move(intake)), station_(std::move(station)), tell_(std::move(tell)) {}

  /// Does what is due, if anything. Blocks as CentreLink.
  /// @returns how many records of that history the centre has; none where it was not asked now.
  std::optional<std::int64_t> look(CentreLink& link, const CentreLink::GoesOn& goes_on);

 private:
  using Steady = std::chrono::steady_clock;

  bool take_page(CentreLink& link, const CentreLink::GoesOn& goes_on);
  bool failed(const std::string& why);

  app::RevisionIntake intake_;
  const std::function<std::string_view()> station_;
  const std::function<void(std::string_view event, const std::string& detail)> tell_;
  std::string position_{};
  std::optional<std::int64_t> size_at_centre_{};
  bool refused_ = false;  ///< something since the beginning
  std::string failure_{};
  Steady::time_point due_{};
  Steady::time_point begun_{};
};

}  // namespace fitgauge::forwarder
