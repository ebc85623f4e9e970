// How JSON files say which parts a shape has: "parts", "groups" and "tolerance". Internal to this room.
#pragma once

#include "partwise/appearance/shapes/shape_file.h"
#include "partwise/base/json_fields.h"

namespace partwise {

inline PartSettings take_part_settings(JsonFields& fields, PartRule otherwise) {
  PartSettings settings;
  settings.rule = fields.choice<PartRule>("parts", otherwise,
                                          {{"whole", PartRule::whole},
                                           {"components", PartRule::components},
                                           {"corise", PartRule::corise},
                                           {"cvf", PartRule::cvf},
                                           {"materials", PartRule::materials},
                                           {"labels", PartRule::labels}});
  settings.groups = fields.whole("groups", settings.groups, 1, 1000);
  if (fields.has("tolerance") && settings.rule != PartRule::corise) {
    fields.refuse("tolerance", "is of corise alone", "leave it out");
  }
  settings.tolerance = fields.number("tolerance", settings.tolerance, 1e-4, 10);
  return settings;
}

inline const char* word_of(PartRule rule) {
  constexpr const char* words[] = {"whole", "components", "corise", "cvf", "materials", "labels"};
  return words[static_cast<int>(rule)];
}

}  // namespace partwise
