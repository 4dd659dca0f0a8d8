#include "schemas/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>
#include <string_view>

#include "schemas/failure.hpp"

namespace cupola {
namespace {

struct UnitFree {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct ConverterFree {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
struct SystemFree {
  void operator()(ut_system* system) const { ut_free_system(system); }
};
using Unit = std::unique_ptr<ut_unit, UnitFree>;
using Converter = std::unique_ptr<cv_converter, ConverterFree>;

struct Dimension {
  std::string_view unit;  ///< SI, as udunits spells it
  std::string_view name;  ///< what it measures, with its article
  std::string_view example;
};

constexpr std::array<Dimension, 25> dimensions{{
    {"m", "a length", "0.5 m"},
    {"s", "a time", "5 s"},
    {"kg", "a mass", "270 kg"},
    {"K", "a temperature", "1675 K"},
    {"1", "a plain number", "0.5"},
    {"m/s", "a speed", "2 mm/s"},
    {"m2", "an area", "2 m2"},
    {"m3", "a volume", "2 m3"},
    {"kg/s", "a mass flow", "1.4 kg/s"},
    {"kg/m3", "a density", "800 kg/m3"},
    {"Pa", "a pressure", "1 bar"},
    {"Pa s", "a viscosity", "2e-5 Pa s"},
    {"m2/s", "a diffusivity", "5e-4 m2/s"},
    {"m3/s", "a volume flow", "2 m3/s"},
    {"J/kg/K", "a specific heat capacity", "850 J/kg/K"},
    {"J/kg", "a specific energy", "250 kJ/kg"},
    {"W/m/K", "a heat conductivity", "1.7 W/m/K"},
    {"W/m2/K", "a heat transfer coefficient", "20 W/m2/K"},
    {"kg/mol", "a molar mass", "28 g/mol"},
    {"N/m", "a stiffness", "1e4 N/m"},
    {"N", "a force", "1 N"},
    {"J", "an energy", "1 kJ"},
    {"W", "a power", "1 kW"},
    {"Hz", "a frequency", "1 Hz"},
    {"coulomb", "an electric charge", "1 C"},
}};

struct Criterion {
  std::string_view unit;
  std::string_view plural;
  std::string_view name;
};
constexpr std::array<Criterion, 3> criteria{{
    {"cell", "cells", "a number of cells"},
    {"sigma", "sigma", "a number of standard errors"},
    {"episode", "episodes", "a number of episodes"},
}};

const Criterion* find_criterion(std::string_view unit) {
  for (const auto& criterion : criteria) {
    if (unit == criterion.unit || unit == criterion.plural) return &criterion;
  }
  return nullptr;
}

ut_system* unit_system() {
  static const std::unique_ptr<ut_system, SystemFree> system = [] {
    ut_set_error_message_handler(ut_ignore);
    return std::unique_ptr<ut_system, SystemFree>(ut_read_xml(nullptr));
  }();
  if (!system) {
    throw Failure(ExitCode::input_output, "the unit database of udunits2 cannot be read: install libudunits2-data");
  }
  return system.get();
}

/// udunits passes over what follows a unit, like a bracket: only the characters of units are let through.
bool may_be_unit(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return c >= 0x80 || std::isalnum(c) != 0 ||
           std::string_view(" ^*/.-+%").find(static_cast<char>(c)) != std::string_view::npos;
  });
}

Unit parse_unit(const std::string& text) { return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8)); }

/// udunits calls reciprocals convertible (`Hz` to `s`); here they are not.
bool same_dimension(const Unit& a, const Unit& b) {
  const Unit quotient(ut_divide(a.get(), b.get()));
  return quotient && ut_is_dimensionless(quotient.get()) != 0;
}

std::string measured_by(const Unit& unit) {
  for (const auto& dimension : dimensions) {
    if (same_dimension(unit, parse_unit(std::string(dimension.unit)))) return std::string(dimension.name);
  }
  return "another kind of quantity";
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

double converted(double number, const std::string& unit_text, const std::string& text, const std::string& si_unit) {
  const auto expected = describe_unit(si_unit);
  if (unit_text == "C") {
    throw UnitError(fmt::format("expected {}, but the `C` of `{}` is the coulomb: write degC or K", expected, text));
  }
  if (unit_text == "ton" || unit_text == "tons") {
    throw UnitError(
        fmt::format("expected {}, but the `ton` of `{}` is the American one: write t for 1000 kg", expected, text));
  }
  const Unit unit = may_be_unit(unit_text) ? parse_unit(unit_text) : nullptr;
  if (!unit)
    throw UnitError(fmt::format("expected {}, but `{}` of `{}` is not a known unit", expected, unit_text, text));
  const Unit si = parse_unit(si_unit);
  if (!same_dimension(unit, si))
    throw UnitError(fmt::format("expected {}, but `{}` is {}", expected, text, measured_by(unit)));
  const Converter converter(ut_get_converter(unit.get(), si.get()));
  // Only temperatures have a zero of their own; others with one are dates (`s since 2000-01-01`).
  if (!converter || (si_unit != "K" && cv_convert_double(converter.get(), 0) != 0))
    throw UnitError(fmt::format("expected {}, but `{}` cannot be converted", expected, text));
  return cv_convert_double(converter.get(), number);
}

}  // namespace

std::string describe_unit(const std::string& si_unit) {
  if (const auto* criterion = find_criterion(si_unit))
    return fmt::format("{} (like 2 {})", criterion->name, criterion->plural);
  for (const auto& dimension : dimensions) {
    if (dimension.unit == si_unit) return fmt::format("{} (like {})", dimension.name, dimension.example);
  }
  return "a quantity in " + si_unit;
}

double to_si(const std::string& text, const std::string& si_unit) {
  const auto expected = describe_unit(si_unit);
  auto rest = trimmed(text);
  if (rest.starts_with('+')) rest.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range) {
    throw UnitError(fmt::format("expected {}, but `{}` is out of the range of numbers", expected, text));
  }
  if (error != std::errc())
    throw UnitError(fmt::format("expected {}, but `{}` is no number with a unit", expected, text));
  const std::string unit_text(trimmed(rest.substr(static_cast<std::size_t>(end - rest.data()))));
  if (unit_text.starts_with(',')) {
    throw UnitError(fmt::format("expected {}, but `{}` has a comma: write a decimal point", expected, text));
  }

  double value = number;
  if (const auto* criterion = find_criterion(si_unit); criterion != nullptr && !unit_text.empty()) {
    if (find_criterion(unit_text) != criterion)
      throw UnitError(fmt::format("expected {}, but `{}` stands here", expected, text));
  } else if (!unit_text.empty()) {
    value = converted(number, unit_text, text, si_unit);
  }
  if (!std::isfinite(value))
    throw UnitError(fmt::format("expected {}, but `{}` is not a finite number", expected, text));
  return value;
}

}  // namespace cupola
