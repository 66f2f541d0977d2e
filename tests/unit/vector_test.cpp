#include "avi/core/vector.hpp"

#include "refusal.hpp"

#include <gtest/gtest.h>

#include <string>

namespace vector_test {

TEST(Checked, HasTheEntriesOfTheVectorAndNoOthers) {
  const avi::detail::Checked<double, 3> v(avi::Vector<double, 3>(1.0, 2.0, 4.0));
  EXPECT_EQ(v[0], 1.0);
  EXPECT_EQ(v(2), 4.0);
  EXPECT_EQ(refusal([&] { (void)v[3]; }),
            "Index of an entry is 3; it must be at least 0 and below 3, the size of the vector.");
  EXPECT_EQ(refusal([&] { (void)v[-1]; }),
            "Index of an entry is -1; it must be at least 0 and below 3, the size of the vector.");
}

TEST(Checked, HasAsManyEntriesInARowAsThereAre) {
  const avi::detail::Checked<double, 3> v(avi::Vector<double, 3>(1.0, 2.0, 4.0));
  EXPECT_EQ(v.segment(1, 2).sum(), 6.0);
  EXPECT_EQ(v.segment<2>(1).sum(), 6.0);
  EXPECT_EQ(v.head(3).sum(), 7.0);
  EXPECT_EQ(v.tail<3>().sum(), 7.0);
  // None of them are everywhere, at the end too.
  EXPECT_EQ(v.segment(3, 0).size(), 0);
  EXPECT_EQ(v.head(0).size(), 0);
  const auto first = [](const std::string& value) {
    return "First of some entries is " + value +
           "; it must be at least 0 and at most 3, the size of the vector.";
  };
  EXPECT_EQ(refusal([&] { (void)v.segment(4, 0); }), first("4"));
  EXPECT_EQ(refusal([&] { (void)v.segment(-1, 1); }), first("-1"));
  const auto count = [](const std::string& value, const std::string& most) {
    return "Number of entries is " + value + "; it must be at least 0 and at most " + most +
           ", for the vector has not more.";
  };
  EXPECT_EQ(refusal([&] { (void)v.segment(1, 3); }), count("3", "2"));
  EXPECT_EQ(refusal([&] { (void)v.segment(1, -1); }), count("-1", "2"));
  EXPECT_EQ(refusal([&] { (void)v.head<4>(); }), count("4", "3"));
  EXPECT_EQ(refusal([&] { (void)v.tail(4); }), count("4", "3"));
}

}  // namespace vector_test
