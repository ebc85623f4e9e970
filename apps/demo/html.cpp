#include "html.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "page_assets.h"
#include "webp.h"

namespace demo {
std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8 | (k < count ? static_cast<unsigned char>(bytes[i + k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string page_head(std::string_view title) {
  return fmt::format(
      R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>{}</title>
<link rel="icon" href="data:,">
<style>
{}</style>
</head>
<body>
<main>
)",
      title, page_style);
}

std::string image(const Picture& picture) {
  return fmt::format("<img src=\"{}\" alt=\"{}\" width=\"{}\" height=\"{}\" loading=\"lazy\" decoding=\"async\">",
                     picture.data, picture.description, picture.width, picture.height);
}

std::string figure(const Picture& picture) {
  return fmt::format("<figure>{}<figcaption>{}</figcaption></figure>\n", image(picture), picture.caption);
}

std::string figures(const std::vector<Picture>& pictures, std::string_view css_class) {
  std::string html = fmt::format("<div class=\"{}\">\n", css_class);
  for (const Picture& picture : pictures) html += figure(picture);
  return html + "</div>\n";
}

std::string table(const Row& heads, const std::vector<Row>& rows) {
  std::string html = "<table>\n<thead><tr>";
  for (const std::string& head : heads) html += fmt::format("<th scope=\"col\">{}</th>", head);
  html += "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows) {
    html += fmt::format("<tr><th scope=\"row\">{}</th>", row.front());
    for (std::size_t i = 1; i < row.size(); ++i) html += fmt::format("<td>{}</td>", row[i]);
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string fact(std::string_view name, std::string_view value, std::string_view unit) {
  return fmt::format("<div><dt>{}</dt><dd>{}{}</dd></div>\n", name, value,
                     unit.empty() ? "" : fmt::format(" <small>{}</small>", unit));
}

std::string thousands(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (auto at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
    text.insert(static_cast<std::size_t>(at), "&#8239;");
  return text;
}

Picture make_picture(const partwise::Image& image, std::string caption, std::string description) {
  return {"data:image/webp;base64," + base64(encode_webp(image)), std::move(caption), std::move(description),
          image.width, image.height};
}

Picture make_drawing(const std::string& svg, std::string caption, std::string description) {
  const auto number = [&](std::string_view name) {
    const std::size_t at = svg.find(fmt::format(" {}=\"", name));
    return at == std::string::npos ? 0 : std::atoi(svg.c_str() + at + name.size() + 3);
  };
  return {"data:image/svg+xml;base64," + base64(svg), std::move(caption), std::move(description), number("width"),
          number("height")};
}

}  // namespace demo
