#include "common/table.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <unistd.h>

// The documentation's gallery (lib/docs/gallery.sh): every experiment with its figure, caption and command.

namespace fs = std::filesystem;

namespace gallery_test {

TEST(Gallery, HasEveryFigureWithItsCaptionAndCommand) {
  const fs::path pages = fs::temp_directory_path() / ("avi_gallery_" + std::to_string(::getpid()));
  ASSERT_EQ(std::system(("'" AVI_SOURCE_DIR "/lib/docs/gallery.sh' '" AVI_BUILD_DIR "/experiments.tsv' '" +
                         pages.string() + "'")
                            .c_str()),
            0);
  const std::string gallery = text_of(pages / "gallery.md");
  const auto table = experiment::Table::read(AVI_BUILD_DIR "/experiments.tsv");
  EXPECT_GT(table.rows.size(), 25u);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const std::string& name = table.text(i, "name");
    std::string chapter = table.text(i, "chapter");
    std::replace(chapter.begin(), chapter.end(), '/', '_');
    const std::string page = text_of(pages / (chapter + ".md"));
    EXPECT_NE(page.find("{#chapter_" + chapter + "}\n"), std::string::npos) << chapter;
    EXPECT_NE(page.find("\n## " + name + "\n"), std::string::npos) << name << " is not on its chapter's page";
    const auto begin = gallery.find("\n### " + name + "\n");
    ASSERT_NE(begin, std::string::npos) << name;
    const std::string entry = gallery.substr(begin, gallery.find("\n##", begin + 4) - begin);
    EXPECT_NE(entry.find(table.text(i, "shows")), std::string::npos) << name;
    if (table.text(i, "figure").empty()) continue;
    EXPECT_NE(entry.find("`make build/figures/" + name + ".pdf`"), std::string::npos) << name;
    EXPECT_EQ(entry.find("\n**\n"), std::string::npos) << table.text(i, "figure") << " has no caption";
  }
  fs::remove_all(pages);
}

}  // namespace gallery_test
