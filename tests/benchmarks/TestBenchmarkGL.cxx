// SPDX-FileCopyrightText: Copyright (c) vtkIBL authors
// SPDX-License-Identifier: BSD-3-Clause
// The benchmark's short form runs, keeps its bounds, and leaves figures that a reader can use.
#include "TestSupport.h"

#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>

class TestBenchmarkGL : public GLTest
{
};

namespace
{
std::string ReadText(const std::string& file)
{
  std::ifstream stream(file);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}
}

// One run, for it takes a minute. It returns 0 only when results.json has its schema and every engine is within its
// stated bound. Mutants: a bound lowered, a panel left out, a curve of one engine lost.
TEST_F(TestBenchmarkGL, QuickFormLeavesItsFigures)
{
  if (GetHDRI("courtyard").empty())
  {
    GTEST_SKIP() << "no HDRIs: install blender-data";
  }
  const std::string output = VTKIBL_OUTPUT;
  std::filesystem::remove_all(output);
  ASSERT_EQ(std::system(("'" VTKIBL_BENCHMARK "' --quick --output '" + output + "'").c_str()), 0);

  const nlohmann::json results = nlohmann::json::parse(ReadText(output + "/results.json"));
  std::map<std::string, double> errors;
  for (const nlohmann::json& result : results.at("results"))
  {
    if (result.at("panel") == "bake" && result.at("default") == true)
    {
      const std::string engine = result.at("engine");
      errors[engine] = result.at("error").at("courtyard").at("relative_l1");
      EXPECT_GT(errors[engine], 0) << engine;
    }
  }
  ASSERT_TRUE(errors.count("vtkIBL") && errors.count("vtkIBL sampled") && errors.count("VTK"));
  EXPECT_LT(errors["vtkIBL"], 0.1 * errors["VTK"]); // else the project has lost its point

  const std::string report = ReadText(output + "/RESULTS.md");
  for (const char* heading : { "## Targets", "## 1. Stages", "## 2. Whole bake", "## 3. Shading", "## 4. Steady",
         "## 5. Probes", "## 6. Cost growth", "## 8. Others", "## Where we are behind", "Repeat: `" })
  {
    EXPECT_NE(report.find(heading), std::string::npos) << heading;
  }
  for (const char* plot : { "stages", "layers", "growth" })
  {
    for (const char* extension : { ".png", ".svg" })
    {
      const std::string file = output + "/plots/" + plot + extension;
      ASSERT_TRUE(std::filesystem::exists(file)) << file;
      EXPECT_GT(std::filesystem::file_size(file), 3000u) << file;
      EXPECT_LT(std::filesystem::file_size(file), 200000u) << file;
    }
  }
}
