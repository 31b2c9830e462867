#include <gtest/gtest.h>
#include <omnimapper/draw/Markup.h>

namespace omnimapper::draw::markup_test {
namespace {

TEST(Markup, tagsAndQuotesAreEscapedAndWhatIsNoUtf8IsReplaced) {
  EXPECT_EQ(escapeMarkup("a<b> & \"c\""), "a&lt;b&gt; &amp; &quot;c&quot;");
  EXPECT_EQ(escapeMarkup("M\xc3\xa1laga \xff\xc3("),
            "M\xc3\xa1laga ?"
            "?(");
}

}  // namespace
}  // namespace omnimapper::draw::markup_test
