#include "deform/scene/operation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "deform/scene/operations.h"
#include "lattice/core/error.h"

namespace espalier {
namespace {

using Type = ParameterType;

const std::vector<Parameter> kParameters = {
    {.name = "size", .type = Type::Number, .help = "how large", .is_required = true},
    {.name = "layers", .type = Type::Integer, .help = "", .fallback = Value(std::int64_t{4})},
    {.name = "from", .type = Type::Numbers, .help = "", .count = 3},
    {.name = "cells", .type = Type::Integers, .help = "", .count = 3},
    {.name = "scheme", .type = Type::Choice, .help = "", .choices = {"a", "b"}},
    {.name = "all", .type = Type::Flag, .help = ""},
    {.name = "path", .type = Type::Path, .help = ""}};

std::string refusal(std::map<std::string, Value> values) {
  values.emplace("size", 1.0);
  try {
    (void)checked(kParameters, Arguments(std::move(values)));
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Operation, fills_in_fallbacks_and_leaves_other_absent_parameters_absent) {
  const Arguments arguments = checked(kParameters, Arguments({{"size", 2.5}}));
  EXPECT_EQ(arguments.number("size"), 2.5);
  EXPECT_EQ(arguments.integer("layers"), 4);
  EXPECT_FALSE(arguments.flag("all"));
  EXPECT_FALSE(arguments.has("from"));
  EXPECT_EQ(arguments.values().size(), 2u);
}

TEST(Operation, keeps_given_values_over_fallbacks) {
  const Arguments arguments =
      checked(kParameters, Arguments({{"size", 1.0},
                                      {"layers", std::int64_t{-7}},
                                      {"from", std::vector<double>{1, -2, 3}},
                                      {"cells", std::vector<std::int64_t>{4, 5, 6}},
                                      {"scheme", std::string("b")},
                                      {"all", true}}));
  EXPECT_EQ(arguments.integer("layers"), -7);
  EXPECT_EQ(arguments.vector("from"), glm::dvec3(1, -2, 3));
  EXPECT_EQ(arguments.integers("cells"), (std::vector<std::int64_t>{4, 5, 6}));
  EXPECT_EQ(arguments.text("scheme"), "b");
  EXPECT_TRUE(arguments.flag("all"));
}

TEST(Operation, names_a_parameter_that_is_missing_or_unknown) {
  EXPECT_EQ(refusal({{"speed", 1.0}}), "there is no parameter 'speed'");
  try {
    (void)checked(kParameters, {});
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_STREQ(error.what(), "'size' is missing: how large");
  }
}

TEST(Operation, names_a_parameter_of_another_type_or_size) {
  EXPECT_EQ(refusal({{"layers", 4.0}}), "'layers' must be a whole number");
  EXPECT_EQ(refusal({{"size", std::string("1")}}), "'size' must be a finite number");
  EXPECT_EQ(refusal({{"from", std::vector<double>{1, 2}}}), "'from' must be 3 finite numbers");
  EXPECT_EQ(refusal({{"cells", std::vector<std::int64_t>{1, 2, 3, 4}}}),
            "'cells' must be 3 whole numbers");
  EXPECT_EQ(refusal({{"scheme", std::string("c")}}), "'scheme' must be one of: a, b");
  EXPECT_EQ(refusal({{"all", std::int64_t{1}}}), "'all' must be true or false");
  EXPECT_EQ(refusal({{"path", std::string()}}), "'path' must be a text that is not empty");
}

TEST(Operation, refuses_numbers_that_are_not_finite_or_do_not_fit) {
  EXPECT_EQ(refusal({{"size", std::nan("")}}), "'size' must be a finite number");
  EXPECT_EQ(refusal({{"from", std::vector<double>{0, 0, INFINITY}}}),
            "'from' must be 3 finite numbers");
  for (const std::int64_t n : {std::numeric_limits<std::int64_t>::min(),
                               std::numeric_limits<std::int64_t>::max(), std::int64_t{1} << 31}) {
    EXPECT_EQ(refusal({{"layers", n}}), "'layers' must be a whole number") << n;
  }
  EXPECT_EQ(refusal({{"layers", std::int64_t{std::numeric_limits<int>::min()}}}), "no error");
}

TEST(Operation, arguments_say_what_they_lack) {
  const Arguments arguments({{"n", 1.0}, {"xy", std::vector<double>{1, 2}}});
  EXPECT_THROW((void)arguments.text("absent"), ParameterError);
  EXPECT_THROW((void)arguments.integer("n"), ParameterError);
  EXPECT_THROW((void)arguments.vector("xy"), ParameterError);
  EXPECT_EQ(arguments.number("n"), 1.0);
}

TEST(Operation, the_table_has_distinct_names_and_tells_all_about_its_parameters) {
  std::set<std::string> names;
  for (const Operation& operation : operations()) {
    EXPECT_TRUE(names.insert(operation.name).second) << operation.name;
    EXPECT_EQ(&operation_named(operation.name), &operation);
    EXPECT_FALSE(operation.summary.empty()) << operation.name;
    std::set<std::string> parameters;
    for (const Parameter& parameter : operation.parameters) {
      EXPECT_TRUE(parameters.insert(parameter.name).second) << parameter.name;
      EXPECT_FALSE(parameter.help.empty()) << operation.name << " " << parameter.name;
      EXPECT_FALSE(parameter.is_required && parameter.fallback) << parameter.name;
    }
  }
  EXPECT_EQ(names, (std::set<std::string>{
                       "attach",      "bind",          "convert",       "crease",      "deform",
                       "delete",      "densify",       "extrude",       "merge",       "mirror",
                       "move points", "new annulus",   "new barbell",   "new bezier",  "new box",
                       "new bspline", "new cylinder",  "new junction",  "new limb",    "new nurbs",
                       "new ogrid",   "new sphere",    "new star",      "new thb",     "new torus",
                       "open",        "pose bend",     "pose move",     "pose rotate", "pose scale",
                       "pose taper",  "pose twist",    "pull",          "refine",      "relax",
                       "save",        "save deformed", "set influence", "set lock",    "set pose",
                       "split",       "transform",     "weld"}));
  EXPECT_THROW((void)operation_named("new"), ParameterError);
}

TEST(Operation, a_new_lattice_enters_the_scene_under_the_name_it_was_given) {
  const Scene scene = apply(operation_named("new box"), {},
                            Arguments({{"cells", std::vector<std::int64_t>{1, 1, 3}},
                                       {"max", std::vector<double>{1, 1, 6}},
                                       {"scheme", std::string("mj96")},
                                       {"output", std::string("tower")}}));
  const SubdivisionLattice& lattice = subdivision_lattice_in(scene, "tower");
  EXPECT_EQ(lattice.complex->n_cells(), 3u);
  EXPECT_EQ(lattice.rest.back(), glm::dvec3(1, 1, 6));
  EXPECT_EQ(lattice.scheme, Scheme::MacCrackenJoy);
}

}  // namespace
}  // namespace espalier
