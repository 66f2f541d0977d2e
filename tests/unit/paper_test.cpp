#include "generate/latex.hpp"
#include "generate/numbers.hpp"
#include "scratch.hpp"
#include "text_of.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

// The paper's text holds together without TeX and without data.

namespace fs = std::filesystem;

namespace paper_test {

const fs::path paper_folder = fs::path(AVI_SOURCE_DIR) / "paper";

const std::array<const char*, 3> documents{"report", "stationary", "bregman"};

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex("(^|[^\\\\])%.*"), "$1");
}

/// A document's sections, paper/<document>/*.tex, without comments.
std::string sections(const std::string& document) {
  std::string text;
  for (const auto& entry : fs::directory_iterator(paper_folder / document))
    text += text_of(entry.path()) + "\n";
  return without_comments(text);
}
/// Those of all three.
std::string sections() {
  std::string text;
  for (const char* document : documents)
    text += sections(document);
  return text;
}

std::set<std::string> set_of(const std::vector<std::string>& list) { return {list.begin(), list.end()}; }

std::set<std::string> column(const fs::path& file, const char* name) {
  const auto table = experiment::Table::read(file);
  std::set<std::string> cells;
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    cells.insert(table.text(i, name));
  return cells;
}

/// Numbers that a text types: three digits or more, or a decimal fraction. What names things (labels,
/// commands, lengths) is not text; 0.9 and 0.99 name the two problems.
std::vector<std::string> typed_numbers(std::string text) {
  for (
      const char* command :
      {R"(\\(label|ref|[cC]ref|cite|includegraphics|generated|fitted|val|made|code|texttt|input|begin|addtocounter|setcounter)(\[[^\]]*\])?\{[^}]*\})",
       R"([0-9.]+(\\textwidth|em|pt|mm))",
       R"((Sections?|Theorems?|Lemmas?|Figures?|Tables?|equations?)[~ ](A?[0-9.]+)+|\([0-9]\.[0-9]\)(--\([0-9]\.[0-9]\))?)",
       R"(delta=10\^\{-10\}|10\^\{-[0-9]+\})"})
    text = std::regex_replace(text, std::regex(command), " ");
  std::vector<std::string> typed;
  for (const auto& number : matches(text, R"(([0-9]+(?:\.[0-9]+)?(?:[eE][-+]?[0-9]+)?))"))
    if ((number.size() > 2 || number.find('.') != std::string::npos) && number != "0.9" && number != "0.99")
      typed.push_back(number);
  return typed;
}

TEST(Paper, TypesNoNumberByHand) {
  EXPECT_EQ(typed_numbers("takes 77878 steps, 12.6 times, at 1.43e-5").size(), 3u);
  EXPECT_TRUE(typed_numbers("\\val{a.1234} at $e=0.9$ in 50 dimensions \\cite{x2021}").empty());
  // Settings that define an experiment and are no result: the grid of step_size_luck, e of eccentricity_gain,
  // pring of Tables 3 and 5, 100 iterations of order_equivalence, orders P of its ends; windows and the large
  // momentum of table6_search, the mean longitude of extreme_eccentricity, h of bound copies.
  const std::set<std::string> settings{"0.6", "1.3", "0.2",  "0.5", "100", "160",
                                       "1.7", "2.4", "1000", "0.1", "9.7"};
  for (const auto& number : typed_numbers(sections()))
    EXPECT_TRUE(settings.contains(number))
        << number << " is typed by hand; paper/numbers.tsv gives numbers names";
}

TEST(Paper, EveryNumberHasItsFormulaAndEveryFormulaItsUse) {
  const auto named = column(paper_folder / "numbers.tsv", "name");
  EXPECT_EQ(named.size(), experiment::Table::read(paper_folder / "numbers.tsv").rows.size())
      << "a name occurs twice";
  const auto used = set_of(matches(sections(), R"(\\val\{([^}#]+)\})"));
  for (const auto& name : used)
    EXPECT_TRUE(named.contains(name) || name == "name") << name << " has no formula";
  for (const auto& name : named)
    EXPECT_TRUE(used.contains(name)) << name << " is not used";
}

/// A number whose sentence says "more" or "less" has its bounds in senses.tsv, and the report is not made
/// where the data say otherwise.
TEST(Paper, SensesOfSentencesAreChecked) {
  const auto named = column(paper_folder / "numbers.tsv", "name");
  for (const auto& name : column(paper_folder / "senses.tsv", "name"))
    EXPECT_TRUE(named.contains(name)) << name << " has no formula";
  const Scratch folder;
  experiment::Table data({"ours", "theirs"}), list({"name", "formula", "format"}),
      senses({"name", "least", "most", "sentence"});
  data.row(1.0, 2.0);
  data.write(folder / "run.tsv");
  list.row("gain", "run[].theirs / run[].ours", "f1");
  senses.row("gain", "1", "inf", "ours takes less");
  const scorecard::Results results({folder});
  EXPECT_NO_THROW(paper::check_senses(results, list, senses));
  senses.rows[0][1] = "2";
  EXPECT_THROW(paper::check_senses(results, list, senses), std::runtime_error);
}

TEST(Paper, RefusesCostsWhoseUnitMoved) {
  experiment::Table advice({"problem", "eccentricity", "horizon", "drift"});
  advice.row("kepler", "0.9", "10", 0.049);
  EXPECT_NO_THROW(paper::refuse_drift(advice));
  advice.row("kepler", "0.99", "10", 0.051);
  EXPECT_THROW(paper::refuse_drift(advice), std::runtime_error);
}

TEST(Paper, EveryFigureHasItsScriptAndEveryTableItsMaker) {
  const std::string text = sections();
  for (const auto& stem : matches(text, R"(\\includegraphics\[[^\]]*\]\{([^}]+)\})"))
    EXPECT_TRUE(lies_in("figures", stem + ".gp")) << stem;
  auto made = column(paper_folder / "tables.tsv", "table");
  made.merge(set_of({"kepler_e090", "kepler_e099", "direct_vs_adaptive", "method_comparison", "p_dependence",
                     "optimiser_comparison", "notes", "claims", "shares"}));
  const auto shown = set_of(matches(text, R"(\\(?:generated|fitted|ledger)\{([^}]+)\})"));
  EXPECT_EQ(shown, made);
}

/// Each document reads its own sections and no other, and what its abstract says fits into 150 words.
TEST(Paper, IsThreeDocumentsWithShortAbstracts) {
  for (const std::string document : documents) {
    const std::string text = text_of(paper_folder / (document + ".tex"));
    std::set<std::string> read;
    for (const auto& input : matches(text, R"(\\input\{([^}]+)\})"))
      if (input != "common") read.insert(input);
    std::set<std::string> there;
    for (const auto& entry : fs::directory_iterator(paper_folder / document))
      there.insert(document + "/" + entry.path().stem().string());
    EXPECT_EQ(read, there);
    std::string abstract = without_comments(text_of(paper_folder / document / "abstract.tex"));
    abstract = std::regex_replace(abstract, std::regex(R"(\\(begin|end)\{abstract\}|\\noindent)"), " ");
    abstract = std::regex_replace(abstract, std::regex(R"(\$[^$]*\$)"), "x");
    std::istringstream words(abstract);
    EXPECT_LE(std::distance(std::istream_iterator<std::string>(words), {}), 150) << document;
  }
}

/// What a reader of the PDF does not need: commands in captions, commits, time stamps.
TEST(Paper, NamesNoCommandInACaption) {
  EXPECT_TRUE(matches(sections(), R"((\\made\{|val\{commit\}|val\{date\}))").empty());
  for (const auto& caption : matches(sections(), R"(\\caption\{([^\n]*))"))
    EXPECT_EQ(caption.find("make "), std::string::npos) << caption;
}

/// A reference within a document is to a label of that document.
TEST(Paper, ReferencesStayWithinTheirDocument) {
  for (const char* document : documents) {
    const std::string text = sections(document);
    auto labels = set_of(matches(text, R"(\\label\{([^}]+)\})"));
    labels.merge(set_of(matches(text, R"(\\ledger\{[^}]*\}\{[^}]*\}\{([^}]+)\})")));
    for (const auto& list : matches(text, R"(\\(?:[cC]ref|eqref)\{([^}]+)\})"))
      for (const auto& key : matches(list, "([^, ]+)"))
        EXPECT_TRUE(labels.contains(key)) << document << ": " << key;
  }
}

/// Every reference has a DOI, or pages of a journal where we know none.
TEST(Paper, EveryReferenceIsCitedAndCanBeFound) {
  const std::string bib = text_of(paper_folder / "references.bib");
  const auto keys = set_of(matches(bib, R"(@[a-z]+\{([a-z0-9]+),)"));
  std::set<std::string> cited;
  for (const auto& list : matches(sections(), R"(\\cite\{([^}]+)\})"))
    for (const auto& key : matches(list, "([^, ]+)"))
      cited.insert(key);
  EXPECT_EQ(cited, keys);
  // By its DOI or address, else by the journal, school, course or ISBN: volumes and pages that could not be
  // checked are left out.
  std::istringstream entries(bib);
  std::string key;
  std::map<std::string, bool> findable;
  for (std::string line; std::getline(entries, line);) {
    if (line.starts_with("@")) key = line.substr(line.find('{') + 1, line.find(',') - line.find('{') - 1);
    for (const char* field :
         {"doi = {10.", "url = {https://", "journal = {", "school = {", "howpublished = {", "ISBN"})
      findable[key] = findable[key] || line.find(field) != std::string::npos;
  }
  for (const auto& [entry, can_be] : findable)
    EXPECT_TRUE(can_be) << entry;
}

/// What `make paper` refuses in TeX's log.
TEST(Log, IsReadForWhatARefereeWouldSee) {
  const Scratch folder;
  const fs::path log = folder / "log";
  const auto accepted = [&](const std::string& line) {
    std::ofstream(log) << "This is pdfTeX\n" << line << "\n";
    const std::string command =
        "'" + (paper_folder / "check_log.sh").string() + "' '" + log.string() + "' >/dev/null";
    return std::system(command.c_str()) == 0;
  };
  EXPECT_TRUE(accepted("Overfull \\hbox (4.9pt too wide) in paragraph at lines 1--2"));
  for (const char* line :
       {"Overfull \\hbox (5.1pt too wide) in paragraph at lines 1--2",
        "Overfull \\vbox (12.0pt too high) detected",
        "LaTeX Warning: Reference `a' on page 1 undefined on input line 2.",
        "LaTeX Warning: Label `a' multiply defined.", "Missing character: There is no x in font y!"})
    EXPECT_FALSE(accepted(line)) << line;
}

/// How long the documents of the last `make paper` may be; CTest looks at their logs by themselves.
TEST(Log, OfTheLastBuildIsOfAdmissibleLength) {
  const std::map<std::string, int> longest{{"report", 20}, {"stationary", 20}, {"bregman", 8}};
  int read = 0;
  for (const auto& [document, pages] : longest) {
    const fs::path log = fs::path(AVI_SOURCE_DIR) / "build/paper" / (document + ".log");
    if (!fs::exists(log)) continue;
    ++read;
    const auto made = matches(text_of(log), R"(\(([0-9]+) pages)");
    ASSERT_FALSE(made.empty()) << log;
    EXPECT_LE(std::stoi(made.back()), pages) << document;
  }
  if (read == 0) GTEST_SKIP() << "`make paper` writes the logs.";
}

TEST(Latex, EscapesTextAndWritesPowers) {
  EXPECT_EQ(paper::latex("50 % of a_b"), "50 \\% of a\\_b");
  EXPECT_EQ(paper::latex("delta = 1e-10, p_ring"), "$\\delta=\\num{1e-10}$, $\\mathring p$");
  EXPECT_EQ(paper::latex("|grad V| = 1/|q|^2"), "$|\\nabla V|=1/|q|^2$");
  EXPECT_EQ(paper::latex("Euler's e = 0.9 at 77878 < 1e7, -2.00 times p; x^1.5, a step of N - 1"),
            "Euler's $e=\\num{0.9}$ at \\num{77878} $<$ \\num{1e7}, \\num{-2.00} times $p$; $x^{1.5}$, a "
            "step of $N-1$");
  EXPECT_EQ(paper::latex("0.00515 to 2.99994 of 77878. `make long`: a Runge-Kutta method"),
            "0.00515 to 2.99994 of \\num{77878}. \\texttt{make long}: a Runge--Kutta method");
  EXPECT_EQ(paper::latex("|p^t + H|^-1 and p^t"), "$|p^t+H|^{-1}$ and $p^t$");
  EXPECT_EQ(paper::escaped("9e92463-dirty a_b"), "9e92463-dirty a\\_b");  // no power of ten
  EXPECT_EQ(paper::latex_printed("1.43E-05"), "\\num{1.43e-5}");
  EXPECT_EQ(paper::latex_printed(">1E10"), "${>}$\\num{1e10}");
  EXPECT_EQ(paper::latex_number(77877.0, "int"), "\\num{77877}");
  EXPECT_EQ(paper::latex_number(1.4286e-5, "g3"), "\\num{1.43e-5}");
  EXPECT_EQ(paper::latex_number(0.0516, "g2"), "\\num{0.052}");
  EXPECT_THROW(paper::latex_number(1.0, "x3"), std::invalid_argument);
}

TEST(Numbers, FormulasReadCells) {
  const Scratch folder;
  experiment::Table table({"method", "h", "steps"});
  table.row("a", 0.1, 180);
  table.row("a", 0.2, 90);
  table.row("b", 0.1, std::nan(""));
  table.write(folder / "runs.tsv");
  const scorecard::Results data({folder});
  EXPECT_EQ(paper::evaluate(data, "runs[method=a,h=1e-1].steps"), 180.0);
  EXPECT_EQ(paper::evaluate(data, "runs[method=a].steps / runs[h=0.2].steps + 1"), 3.0);
  EXPECT_EQ(paper::evaluate(data, "max:runs[].steps"), 180.0);
  EXPECT_EQ(paper::evaluate(data, "sum:runs[method=a].steps"), 270.0);
  EXPECT_EQ(paper::evaluate(data, "median:runs[method=a].steps"), 135.0);
  EXPECT_EQ(paper::evaluate(data, "median:runs[].h"), 0.1);
  EXPECT_EQ(paper::evaluate(data, "count:runs[h=0.1] * 5"), 10.0);
  EXPECT_EQ(paper::evaluate(data, "min:runs[].steps:h"), 450.0);
  EXPECT_EQ(paper::evaluate(data, "max:runs[].steps-h"), 179.9);
  EXPECT_EQ(paper::evaluate(data, "count:runs[h<0.15]"), 2.0);
  EXPECT_EQ(paper::evaluate(data, "place:runs[h=0.2]"), 2.0);
  EXPECT_EQ(paper::evaluate(data, "count:runs[method=a|b,h=0.1|0.3]"), 2.0);
  EXPECT_THROW(paper::evaluate(data, "runs[method=c].steps"), std::out_of_range);
  EXPECT_THROW(paper::evaluate(data, "runs.steps"), std::invalid_argument);
  EXPECT_THROW(paper::evaluate(data, "runs[].steps %"), std::invalid_argument);
  EXPECT_THROW(paper::evaluate(data, "mean:runs[].steps"), std::invalid_argument);
  EXPECT_THROW(paper::evaluate(data, "walks[].steps"), std::runtime_error);
}

}  // namespace paper_test
