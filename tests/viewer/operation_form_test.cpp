#include "viewer/interact/operation_form.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "deform/scene/operations.h"
#include "lattice/core/error.h"

namespace espalier::viewer {
namespace {

FormField& field(OperationForm& form, const std::string& name) {
  return *std::find_if(form.fields.begin(), form.fields.end(), [&](const FormField& candidate) {
    return candidate.parameter->name == name;
  });
}

TEST(OperationForm, says_what_its_fallbacks_say_for_every_operation) {
  for (const Operation& operation : operations()) {
    OperationForm form = form_for(operation, {{"m.obj"}, {"a.json"}, {}, "a.json", "", {}});
    ASSERT_EQ(form.fields.size(), operation.parameters.size());
    Arguments required;
    for (FormField& entry : form.fields) {
      if (entry.parameter->is_required && entry.text.empty()) {
        entry.text = entry.parameter->type == ParameterType::Choice ? entry.choices.front()
                     : entry.parameter->type == ParameterType::Numbers ||
                             entry.parameter->type == ParameterType::Integers
                         ? "1 2 3"
                         : "1";
      }
    }
    const OperationCall call = form.call();
    EXPECT_EQ(call.operation, operation.name);
    EXPECT_NO_THROW((void)checked(operation.parameters, call.arguments)) << text_of(call);
    for (const Parameter& parameter : operation.parameters) {
      if (parameter.fallback) {
        EXPECT_EQ(call.arguments.values().at(parameter.name), *parameter.fallback)
            << operation.name << " " << parameter.name;
      }
    }
  }
}

TEST(OperationForm, begins_with_the_chosen_lattice_and_what_is_selected) {
  LatticeElements elements;
  elements.edges.push_back(std::array{3, 7});
  elements.edges.push_back(std::array{7, 9});
  const FormContext context{{}, {"a.json", "b.json"}, {},     "b.json",
                            "", ElementKind::Edge,    {0, 1}, &elements};
  OperationForm form = form_for(operation_named("crease"), context);
  EXPECT_EQ(field(form, "lattice").text, "b.json");
  EXPECT_EQ(field(form, "output").text, "b.json");
  EXPECT_EQ(field(form, "edges").text, "3-7,7-9");
  EXPECT_EQ(field(form, "vertices").text, "");
  EXPECT_EQ(text_of(form.call()),
            "crease lattice=b.json edges=3-7,7-9 all=false sharpness=10 output=b.json");
}

TEST(OperationForm, a_new_lattice_goes_round_the_model_and_a_conversion_begins_with_it) {
  const FormContext context{{"m.obj"}, {"a.json"}, {}, "a.json", ""};
  OperationForm limb = form_for(operation_named("new limb"), context);
  EXPECT_EQ(field(limb, "fit").text, "m.obj");
  OperationForm conversion = form_for(operation_named("convert"), context);
  EXPECT_EQ(field(conversion, "mesh").text, "m.obj");
  EXPECT_EQ(field(conversion, "output").text, "lattice.json");
  OperationForm refinement = form_for(operation_named("refine"), context);
  EXPECT_EQ(field(refinement, "output").text, "a.json");
}

TEST(OperationForm, names_new_lattices_after_the_operation_in_the_folder) {
  const FormContext context{{}, {"dir/torus.json"}, {}, "", "dir"};
  OperationForm form = form_for(operation_named("new torus"), context);
  EXPECT_EQ(field(form, "output").text, "dir/torus2.json");
}

TEST(OperationForm, numbers_may_stand_apart_by_blanks_and_texts_may_hold_anything) {
  OperationForm form = form_for(operation_named("new box"), {});
  field(form, "cells").text = " 2  3, 4 ";
  field(form, "output").text = "a \"b\" \\c=#.json";
  const OperationCall call = form.call();
  EXPECT_EQ(call.arguments.integers("cells"), (std::vector<std::int64_t>{2, 3, 4}));
  EXPECT_EQ(call.arguments.text("output"), "a \"b\" \\c=#.json");
}

TEST(OperationForm, one_line_is_one_value_of_a_list) {
  OperationForm form = form_for(operation_named("merge"), {});
  field(form, "lattice").text = "a.json\nb.json";
  field(form, "output").text = "c.json";
  EXPECT_EQ(form.call().arguments.texts("lattice"), (std::vector<std::string>{"a.json", "b.json"}));
}

TEST(OperationForm, names_what_is_missing_or_cannot_be_read) {
  OperationForm form = form_for(operation_named("open"), {});
  EXPECT_THROW((void)form.call(), ParameterError);
  form = form_for(operation_named("new box"), {});
  field(form, "cells").text = "2 x 2";
  EXPECT_THROW((void)form.call(), ParameterError);
}

}  // namespace
}  // namespace espalier::viewer
