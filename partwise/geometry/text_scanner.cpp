#include "partwise/geometry/text_scanner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "partwise/base/error.h"

namespace partwise {
namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }

// After a backslash at `at` that ends its line, the start of the next; else null.
const char* after_continuation(const char* at, const char* end) {
  if (*at != '\\') return nullptr;
  ++at;
  if (at != end && *at == '\r') ++at;
  return at != end && *at == '\n' ? at + 1 : nullptr;
}

char lower_case(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

// Of a number that no double can hold: whether it is nearer to zero than the smallest, not farther than the largest.
// std::from_chars does not tell, and std::strtod depends on the locale.
bool is_too_small(std::string_view number) {
  const std::size_t exponent = number.find_first_of("eE");
  if (exponent != std::string_view::npos) return number.substr(exponent + 1).starts_with('-');
  return number.substr(number.find_first_not_of("+-")).starts_with("0") || number.find('.') <= 1;
}

}  // namespace

TextScanner::TextScanner(std::string file, std::string_view text, char comment)
    : file_(std::move(file)),
      begin_(text.data()),
      next_(text.data()),
      end_(text.data() + text.size()),
      comment_(comment) {
  if (text.starts_with("\xEF\xBB\xBF")) next_ += 3;  // the byte order mark of UTF-8
}

void TextScanner::skip_blanks(bool across_lines) {
  while (next_ != end_) {
    if (*next_ == '\n') {
      if (!across_lines) break;
      ++next_;
    } else if (is_blank(*next_)) {
      ++next_;
    } else if (const char* joined = after_continuation(next_, end_)) {
      next_ = joined;
    } else if (comment_ != kNoComments && *next_ == comment_) {
      next_ = std::find(next_, end_, '\n');
    } else {
      break;
    }
  }
  token_start_ = position();
}

std::string_view TextScanner::take() {
  const char* start = next_;
  while (next_ != end_ && !is_blank(*next_) && !after_continuation(next_, end_)) ++next_;
  return {start, static_cast<std::size_t>(next_ - start)};
}

std::string_view TextScanner::token() {
  skip_blanks(true);
  return take();
}

std::string_view TextScanner::token_in_line() {
  skip_blanks(false);
  if (next_ != end_ && *next_ == '\n') return {};
  return take();
}

void TextScanner::skip_line() {
  next_ = std::find(next_, end_, '\n');
  if (next_ != end_) ++next_;
}

bool TextScanner::at_end() {
  skip_blanks(true);
  return next_ == end_;
}

bool TextScanner::at_line_end() {
  skip_blanks(false);
  return next_ == end_ || *next_ == '\n';
}

double TextScanner::coordinate(std::string_view what) {
  const std::string_view text = token();
  if (text.empty()) {
    fail(fmt::format("the file ends where {} should be", what), "it was cut short: copy or export it again");
  }
  const char* first = text.data() + (text.front() == '+' ? 1 : 0);
  const char* last = text.data() + text.size();
  double value = 0;
  auto [stop, error] = std::from_chars(first, last, value);
  if (error == std::errc::result_out_of_range && stop == last) {
    value = is_too_small(text) ? 0.0 : std::numeric_limits<double>::infinity();
  } else if (error != std::errc() || stop != last) {
    fail(fmt::format("{} is not a number where {} should be", shown(text), what), "correct the line");
  }
  if (!std::isfinite(value)) {
    fail(fmt::format("{} is {}, which is not finite", what, shown(text)), "correct or remove what holds it");
  }
  return value;
}

std::int64_t TextScanner::integer(std::string_view what) { return to_integer(token(), what); }

std::int64_t TextScanner::to_integer(std::string_view text, std::string_view what) const {
  if (text.empty()) {
    fail(fmt::format("the file ends where {} should be", what), "it was cut short: copy or export it again");
  }
  const char* last = text.data() + text.size();
  std::int64_t value = 0;
  const auto [stop, error] = std::from_chars(text.data() + (text.front() == '+' ? 1 : 0), last, value);
  if (error != std::errc() || stop != last) {
    fail(fmt::format("{} is not an integer where {} should be", shown(text), what), "correct the line");
  }
  return value;
}

std::string TextScanner::place(std::size_t position) const {
  return fmt::format("{}:{}", file_, 1 + std::count(begin_, begin_ + position, '\n'));
}

void TextScanner::fail(const std::string& problem, const std::string& remedy) const {
  throw InputError(place(), problem, remedy);
}

std::string shown(std::string_view token) {
  constexpr std::size_t kLongest = 24;
  std::string text = "'";
  for (const char c : token.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (token.size() > kLongest ? "...'" : "'");
}

std::string shown_reason(std::string_view reason) {
  constexpr std::size_t kLongest = 120;
  std::string text;
  for (const char c : reason.substr(0, kLongest)) text += c >= ' ' && c <= '~' ? c : '?';
  return text + (reason.size() > kLongest ? "..." : "");
}

bool equals_ignoring_case(std::string_view token, std::string_view lower) {
  return std::equal(token.begin(), token.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return lower_case(a) == b; });
}

}  // namespace partwise
