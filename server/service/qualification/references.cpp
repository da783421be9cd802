#include <sstream>

#include "service/qualification/qualification.hpp"

namespace fitgauge::app::qualification {

std::vector<Words> References::rows(const std::string& file) const {
  std::vector<Words> rows;
  std::istringstream in(files.at(file));
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    rows.emplace_back();
    for (std::string word; words >> word;) rows.back().push_back(word);
  }
  return rows;
}

std::vector<Words> References::set(const std::string& name) const {
  std::vector<Words> set;
  bool is_in = false;
  for (Words& row : rows("data.txt")) {
    if (row[0] == "==") {
      is_in = row[1] == name;
    } else if (is_in) {
      set.push_back(std::move(row));
    }
  }
  return set;
}

}  // namespace fitgauge::app::qualification
