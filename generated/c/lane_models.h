/* The lane kernels of every drive. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#include "cylindrical_worm_za_za_lanes.h"
#include "cylindrical_worm_za_zi_lanes.h"
#include "cylindrical_worm_za_zn_lanes.h"
#include "cylindrical_worm_za_zk_lanes.h"
#include "cylindrical_worm_za_zc_lanes.h"
#include "cylindrical_worm_zi_za_lanes.h"
#include "cylindrical_worm_zi_zi_lanes.h"
#include "cylindrical_worm_zi_zn_lanes.h"
#include "cylindrical_worm_zi_zk_lanes.h"
#include "cylindrical_worm_zi_zc_lanes.h"
#include "cylindrical_worm_zn_za_lanes.h"
#include "cylindrical_worm_zn_zi_lanes.h"
#include "cylindrical_worm_zn_zn_lanes.h"
#include "cylindrical_worm_zn_zk_lanes.h"
#include "cylindrical_worm_zn_zc_lanes.h"
#include "cylindrical_worm_zk_za_lanes.h"
#include "cylindrical_worm_zk_zi_lanes.h"
#include "cylindrical_worm_zk_zn_lanes.h"
#include "cylindrical_worm_zk_zk_lanes.h"
#include "cylindrical_worm_zk_zc_lanes.h"
#include "cylindrical_worm_zc_za_lanes.h"
#include "cylindrical_worm_zc_zi_lanes.h"
#include "cylindrical_worm_zc_zn_lanes.h"
#include "cylindrical_worm_zc_zk_lanes.h"
#include "cylindrical_worm_zc_zc_lanes.h"
#include "spherical_convex_convex_lanes.h"
#include "spherical_convex_concave_lanes.h"
#include "spherical_convex_spur_lanes.h"
#include "spherical_concave_convex_lanes.h"
#include "spherical_concave_concave_lanes.h"
#include "spherical_concave_spur_lanes.h"
#include "spherical_spur_convex_lanes.h"
#include "spherical_spur_concave_lanes.h"
#include "spherical_spur_spur_lanes.h"
#include "face_worm_lanes.h"

static const mw_lane_model mw_lane_models[] = {
    MW_LANE_MODEL(cylindrical_worm_za_za),
    MW_LANE_MODEL(cylindrical_worm_za_zi),
    MW_LANE_MODEL(cylindrical_worm_za_zn),
    MW_LANE_MODEL(cylindrical_worm_za_zk),
    MW_LANE_MODEL(cylindrical_worm_za_zc),
    MW_LANE_MODEL(cylindrical_worm_zi_za),
    MW_LANE_MODEL(cylindrical_worm_zi_zi),
    MW_LANE_MODEL(cylindrical_worm_zi_zn),
    MW_LANE_MODEL(cylindrical_worm_zi_zk),
    MW_LANE_MODEL(cylindrical_worm_zi_zc),
    MW_LANE_MODEL(cylindrical_worm_zn_za),
    MW_LANE_MODEL(cylindrical_worm_zn_zi),
    MW_LANE_MODEL(cylindrical_worm_zn_zn),
    MW_LANE_MODEL(cylindrical_worm_zn_zk),
    MW_LANE_MODEL(cylindrical_worm_zn_zc),
    MW_LANE_MODEL(cylindrical_worm_zk_za),
    MW_LANE_MODEL(cylindrical_worm_zk_zi),
    MW_LANE_MODEL(cylindrical_worm_zk_zn),
    MW_LANE_MODEL(cylindrical_worm_zk_zk),
    MW_LANE_MODEL(cylindrical_worm_zk_zc),
    MW_LANE_MODEL(cylindrical_worm_zc_za),
    MW_LANE_MODEL(cylindrical_worm_zc_zi),
    MW_LANE_MODEL(cylindrical_worm_zc_zn),
    MW_LANE_MODEL(cylindrical_worm_zc_zk),
    MW_LANE_MODEL(cylindrical_worm_zc_zc),
    MW_LANE_MODEL(spherical_convex_convex),
    MW_LANE_MODEL(spherical_convex_concave),
    MW_LANE_MODEL(spherical_convex_spur),
    MW_LANE_MODEL(spherical_concave_convex),
    MW_LANE_MODEL(spherical_concave_concave),
    MW_LANE_MODEL(spherical_concave_spur),
    MW_LANE_MODEL(spherical_spur_convex),
    MW_LANE_MODEL(spherical_spur_concave),
    MW_LANE_MODEL(spherical_spur_spur),
    MW_LANE_MODEL(face_worm),
};
