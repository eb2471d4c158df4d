/* SPDX-FileCopyrightText: 2026 The openmb4 authors
 * SPDX-License-Identifier: Apache-2.0
 *
 * As much of Zephyr's devicetree.h as the sensor uses. There is one node, and the test gives its
 * properties: DT_0_NAME, DT_0_HAS_NAME. */
#ifndef ZEPHYR_DEVICETREE_H_
#define ZEPHYR_DEVICETREE_H_

#define DT_NODELABEL(label) label
#define DT_INST_PROP(inst, prop) DT_##inst##_##prop
#define DT_INST_ENUM_IDX(inst, prop) DT_##inst##_##prop
#define DT_INST_NODE_HAS_PROP(inst, prop) DT_##inst##_HAS_##prop
#define DT_INST_PROP_OR(inst, prop, other) \
  (DT_INST_NODE_HAS_PROP(inst, prop) ? DT_INST_PROP(inst, prop) : (other))
#define DT_INST_FOREACH_STATUS_OKAY(function) function(0)

#endif
