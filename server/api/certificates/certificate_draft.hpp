#pragma once

#include "api/plans/characteristic_key.hpp"
#include "api/resources.hpp"
#include "service/measurements/measurement_service.hpp"

namespace fitgauge::api {

/// The request for a certificate.
struct CertificateOrder {
  std::vector<std::pair<std::string, std::string>> of{};  ///< order, part_id: its subject
  std::string title{};
  std::string company{};
  std::string customer{};
  certificate::Paper paper = certificate::Paper::A4;
  bool as_json = false;
  std::string own_origin{};  ///< `http://host:port`, for the QR code
};

/// Collects measurements while they are read, then writes a certificate. One thread at a time.
class CertificateDraft {
 public:
  explicit CertificateDraft(CertificateOrder order) : order_(std::move(order)) {}

  const CertificateOrder& order() const { return order_; }
  std::size_t count() const { return values_.size(); }
  std::size_t bytes() const { return bytes_; }                      ///< of the records
  const std::string& last_id() const { return values_.back().id; }  ///< @pre count() > 0

  void add(const app::Measurement& measurement);
  /// @param plan of the part that the report is of
  void hold_against(PlanOfPart plan) { plan_ = std::move(plan); }

  /// @param checkpoint the signed head of the log
  std::string json(Timestamp made_at, const std::string& checkpoint);
  /// Once. @throws std::runtime_error as certificate::to_pdf does.
  std::string pdf(Timestamp made_at, const std::string& checkpoint,
                  const certificate::Letterhead& letterhead);

 private:
  /// Fields of a value that the verdict of the report needs.
  struct Counted {
    Candidate candidate{};
    std::string id{};
    gauging::Verdict verdict{};
    std::pair<int, double> badness{};  ///< by its verdict, then by its share of the tolerance
    Length decisive{};
    Length beyond{};        ///< the nearest limit; less than 0 is inside
    bool is_upper = false;  ///< that limit
  };

  void count(const app::Measurement& measurement);
  /// The worst value of those that count; nullptr if none has limits.
  const Counted* worst() const;
  static std::string text_of(const Counted& value, const certificate::Line& line);
  std::size_t measured_again() const;
  /// Returns false if no value has limits, or if all are good but one is missing.
  bool has_verdict() const;
  std::string summary() const;

  CertificateOrder order_;
  std::size_t bytes_ = 0;
  app::VerdictTally verdicts_{};
  std::optional<PlanOfPart> plan_;  ///< of a part
  std::string records_;             ///< JSON, with commas between them
  std::vector<certificate::Line> lines_;
  /// A gauge, as the records name it.
  struct UsedGauge {
    std::string name{};
    std::string budget{};
    std::optional<Length> standard_uncertainty{};  ///< of the budget
    std::string overdue_since{};
    std::string certificate{};  ///< of the calibration that was valid
    std::string laboratory{};
    bool is_blocked = false;  ///< when it measured

    friend auto operator<=>(const UsedGauge&, const UsedGauge&) = default;
  };
  std::set<UsedGauge> gauges_;
  std::map<std::string, int> revisions_;
  std::set<std::string, std::less<>> parts_;
  std::map<std::string, std::size_t> rules_;  ///< in words, numbered from 1 on
  std::vector<Counted> values_;               ///< in the order of lines_
};

}  // namespace fitgauge::api
