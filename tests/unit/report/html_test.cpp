#include "report/html.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <string_view>

namespace breccia::report::html_test {
namespace {

std::string base64_of(std::string_view text) { return base64(std::as_bytes(std::span(text.data(), text.size()))); }

TEST(Escaped, TextHasNoMeaningInHtml) {
  EXPECT_EQ(escaped("<script>alert(\"x\" & 'y')</script>"),
            "&lt;script&gt;alert(&quot;x&quot; &amp; &#39;y&#39;)&lt;/script&gt;");
  EXPECT_EQ(escaped("a\tb\nc"), "a\tb\nc");
}

TEST(Escaped, CharactersOfUtf8StayAndOtherBytesAreReplaced) {
  const std::string kept = "µm², 花崗岩, \xf0\x9f\xaa\xa8";
  EXPECT_EQ(escaped(kept), kept);
  const std::string replacement = "\xef\xbf\xbd";
  EXPECT_EQ(escaped("a\xff"
                    "b"),
            "a" + replacement + "b");
  EXPECT_EQ(escaped("\xc0\xbc"), replacement + replacement);                    // '<' in two bytes
  EXPECT_EQ(escaped("\xe0\x80\xbc"), replacement + replacement + replacement);  // in three
  EXPECT_EQ(escaped("\xe2\x82"), replacement + replacement);                    // cut off
  EXPECT_EQ(escaped(std::string_view("\0\x1b[2J", 5)), replacement + replacement + "[2J");
}

TEST(Quantity, HasPrefixesThatFitTheUnit) {
  EXPECT_EQ(quantity(1.2345e-5, "s"), "12.3 µs");
  EXPECT_EQ(quantity(-25e-6, "J"), "−25 µJ");
  EXPECT_EQ(quantity(6.51e-3, "m2"), "6,510 mm²");
  EXPECT_EQ(quantity(2, "m2"), "2 m²");
  EXPECT_EQ(quantity(3.2e-6, "m3"), "3,200 mm³");
  EXPECT_EQ(quantity(0.05, "kg"), "50 g");
  EXPECT_EQ(quantity(4200, "kg"), "4,200 kg");
}

TEST(Quantity, PureNumbersHaveNoPrefix) {
  EXPECT_EQ(quantity(0.904, ""), "0.904");
  EXPECT_EQ(quantity(2.05e-5, ""), "2.05 × 10⁻⁵");
  EXPECT_EQ(quantity(1234, ""), "1,230");
  EXPECT_EQ(quantity(0, ""), "0");
  EXPECT_EQ(quantity(std::numeric_limits<double>::quiet_NaN(), "J"), "–");
}

TEST(Base64, IsThatOfTheStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64_of("\xff\xfe\xfd"), "//79");
}

TEST(Cells, KeepAllDigitsOfTheirNumbers) {
  EXPECT_EQ(Cell::number_of(0.1, "J").html, "<data value=\"0.10000000000000001\">100 mJ</data>");
  EXPECT_EQ(Cell::count(12345678).html, "<data value=\"12345678\">12,345,678</data>");
  EXPECT_EQ(Cell::number_of(std::numeric_limits<double>::infinity(), "J").html, "–");
}

TEST(Tables, NameTheirRowsAndColumns) {
  const std::string html = Table{"a & b", {"term", "energy"}, {{Cell::text("<k>"), Cell::number_of(1, "J")}}}.html();
  EXPECT_NE(html.find("<caption>a &amp; b</caption>"), std::string::npos) << html;
  EXPECT_NE(html.find("<th scope=\"col\">term</th><th scope=\"col\" class=\"n\">energy</th>"), std::string::npos)
      << html;
  EXPECT_NE(html.find("<th scope=\"row\">&lt;k&gt;</th><td class=\"n\">"), std::string::npos) << html;
  EXPECT_EQ((Table{"empty", {"a"}, {}}.html()), "");
}

}  // namespace
}  // namespace breccia::report::html_test
