#include "formats/measuring_log/measuring_log.hpp"

namespace fitgauge::log_reader {
namespace {

/// The text of an element, its kind and its begin.
struct Element {
  std::string name;  ///< h1, h2, h3, p, tr
  std::string text;  ///< of a row the cells, each closed by a tab
  std::size_t at = 0;
};

std::string plain(std::string_view html) {
  constexpr std::array<std::pair<std::string_view, char>, 6> kEntities{{{"&amp;", '&'},
                                                                        {"&lt;", '<'},
                                                                        {"&gt;", '>'},
                                                                        {"&quot;", '"'},
                                                                        {"&#39;", '\''},
                                                                        {"&nbsp;", ' '}}};
  std::string text;
  while (!html.empty()) {
    const auto entity = std::ranges::find_if(
        kEntities, [html](const auto& known) { return html.starts_with(known.first); });
    if (entity != kEntities.end()) {
      text += entity->second;
      html.remove_prefix(entity->first.size());
    } else {
      const char c = html.front();
      text += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
      html.remove_prefix(1);
    }
  }
  return text;
}

/// `td` of `<td class="judged">`, `/td` of `</td>`.
std::string tag_name(std::string_view tag) {
  return ascii_lower(tag.substr(0, std::min(tag.find_first_of(" \t\r\n"), tag.size())));
}

bool is_kept(std::string_view name) {
  return name == "h1" || name == "h2" || name == "h3" || name == "p" || name == "tr";
}

/// Headings, paragraphs and rows of a page in their order, up to the end of the page.
std::vector<Element> elements_of(std::string_view page) {
  std::vector<Element> elements;
  std::optional<Element> open;
  const auto close = [&] {
    if (open) elements.push_back(*std::exchange(open, std::nullopt));
  };
  for (std::size_t at = 0; at < page.size();) {
    const std::size_t tag = std::min(page.find('<', at), page.size());
    if (open) open->text += plain(page.substr(at, tag - at));
    if (tag == page.size()) break;
    const std::size_t end = page.find('>', tag);
    if (end == std::string_view::npos) break;
    const std::string name = tag_name(page.substr(tag + 1, end - tag - 1));
    if (is_kept(name)) {
      close();
      open = Element{name, {}, tag};
    } else if (open && (name == "/td" || name == "/th")) {
      open->text += '\t';
    } else if (open && name == "/" + open->name) {
      close();
    }
    at = end + 1;
    if (name == "style" || name == "script") at = std::min(page.find("</" + name, at), page.size());
  }
  close();
  return elements;
}

std::vector<std::string> cells_of(const Element& row) {
  std::vector<std::string> cells;
  std::string_view rest = row.text;
  while (!rest.empty()) cells.emplace_back(trim(take_field(rest, '\t')));
  return cells;
}

/// `… on 20-11-2026 at 6:05:04`
std::optional<sheet::WallTime> time_of(std::string_view heading) {
  const std::size_t at = heading.rfind(" at ");
  if (at == std::string_view::npos) return std::nullopt;
  const std::size_t on = heading.rfind(' ', at - 1);
  if (on == std::string_view::npos) return std::nullopt;
  return read_clock(trim(heading.substr(on + 1, at - on - 1)), trim(heading.substr(at + 4)));
}

/// The text before the first section of a page.
struct Head {
  int cycle = 0;
  std::string program{};
  bool inch = false;
};

class HtmlReader {
 public:
  explicit HtmlReader(std::string_view page) : page_(page) {}

  Reading read() && {
    for (const Element& element : elements_of(page_)) {
      take(element);
      if (head_.cycle == 0 && element.name != "h1") break;
    }
    if (head_.cycle == 0) {
      reading_.unread.push_back({1, "this page is not a log of a touch-probe cycle"});
      return std::move(reading_);
    }
    // A section that is being written has no end tag yet.
    const std::string_view tail = page_.substr(std::min(begins_, page_.size()));
    if (is_inside_ && tail.find("</section>") == std::string_view::npos) {
      reading_.is_unfinished = true;
      return std::move(reading_);
    }
    end(page_.size());
    if (reading_.logs.empty() && reading_.unread.empty()) {
      reading_.unread.push_back(
          {1, fmt::format("the page of cycle {} has no section", head_.cycle)});
    }
    return std::move(reading_);
  }

 private:
  void take(const Element& element) {
    const std::string lower = ascii_lower(trim(element.text));
    if (element.name == "h1") {
      head_.cycle = cycle_of_title(lower).value_or(0);
    } else if (element.name == "h2") {
      end(element.at);
      begin(element);
    } else if (element.name == "h3") {
      axis_ = trim(element.text);
    } else if (element.name == "p" && !is_inside_) {
      if (const std::size_t colon = element.text.find(": ");
          colon != std::string::npos && lower.find("program") != std::string::npos) {
        head_.program = trim(std::string_view(element.text).substr(colon + 2));
      }
      if (lower.find("in inch") != std::string::npos) head_.inch = true;
    } else if (element.name == "tr" && is_inside_) {
      take_row(element);
    }
  }

  void take_row(const Element& row) {
    const auto cells = cells_of(row);
    if (cells.size() < 2) return;
    const std::string label = ascii_lower(cells.front());
    if (log_.cycle == 444) return take_point_row(label, cells.back(), row.at);
    if (cells.size() != 2) return;
    log_.values.push_back({.name = axis_.empty() ? cells[0] : axis_ + ", " + cells[0],
                           .is_length = false,
                           .printed = cells[1]});
  }

  void take_point_row(const std::string& label, const std::string& digits, std::size_t at) {
    LogValue& value = log_.values.front();
    const bool is_actual = label == "actual" || label == "istwert" || label == "ist";
    const bool is_upper = label.starts_with("upper") || label.starts_with("ober");
    const bool is_lower = label.starts_with("lower") || label.starts_with("unter");
    if (!is_actual && !is_upper && !is_lower) return;
    const auto length = read_length(digits, log_.inch);
    if (!length) return spoil(at, fmt::format("'{}' is not a length", digits));
    if (is_actual) {
      value.measured = *length;
      value.printed = digits;
      has_actual_ = true;
    } else {
      (is_upper ? value.upper : value.lower) = *length;
    }
  }

  void begin(const Element& heading) {
    is_inside_ = true;
    is_spoiled_ = has_actual_ = false;
    begins_ = heading.at;
    axis_.clear();
    log_ = {.cycle = head_.cycle,
            .program = head_.program,
            .time = time_of(trim(heading.text)),
            .inch = head_.inch};
    if (head_.cycle == 444) {
      log_.values.push_back({.name = "Deviation along the surface normal", .role = Role::Shaft});
      log_.values.front().nominal = Length();
    }
  }

  void end(std::size_t at) {
    if (!is_inside_) return;
    is_inside_ = false;
    log_.text = page_.substr(begins_, at - begins_);
    const bool has_values = log_.cycle == 444 ? has_actual_ : !log_.values.empty();
    if (!has_values) spoil(begins_, fmt::format("the log of cycle {} has no values", log_.cycle));
    if (log_.cycle == 444 && has_actual_) {
      const LogValue& value = log_.values.front();
      if (value.upper.has_value() != value.lower.has_value())
        spoil(begins_, "one limit of the point is missing");
    }
    if (!is_spoiled_) reading_.logs.push_back(std::move(log_));
  }

  void spoil(std::size_t at, std::string why) {
    if (!is_spoiled_ && reading_.unread.size() < kMostUnread)
      reading_.unread.push_back({line_of(at), std::move(why)});
    is_spoiled_ = true;
  }

  std::size_t line_of(std::size_t at) const {
    return 1 + static_cast<std::size_t>(std::count(
                   page_.begin(), page_.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }

  std::string_view page_;
  Head head_;
  Reading reading_;
  bool is_inside_ = false;
  bool is_spoiled_ = false;
  bool has_actual_ = false;
  std::size_t begins_ = 0;
  std::string axis_;
  MeasuringLog log_;
};

}  // namespace

Reading read_html_logs(std::string_view bytes) {
  const std::string text = as_utf8(bytes);
  return HtmlReader(text).read();
}

}  // namespace fitgauge::log_reader
