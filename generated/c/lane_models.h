/* The lane kernels of every drive. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
#include "cylindrical_worm_za_za_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
#include "cylindrical_worm_za_zi_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
#include "cylindrical_worm_za_zn_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
#include "cylindrical_worm_za_zk_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
#include "cylindrical_worm_za_zc_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
#include "cylindrical_worm_zi_za_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
#include "cylindrical_worm_zi_zi_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
#include "cylindrical_worm_zi_zn_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
#include "cylindrical_worm_zi_zk_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
#include "cylindrical_worm_zi_zc_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
#include "cylindrical_worm_zn_za_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
#include "cylindrical_worm_zn_zi_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
#include "cylindrical_worm_zn_zn_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
#include "cylindrical_worm_zn_zk_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
#include "cylindrical_worm_zn_zc_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
#include "cylindrical_worm_zk_za_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
#include "cylindrical_worm_zk_zi_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
#include "cylindrical_worm_zk_zn_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
#include "cylindrical_worm_zk_zk_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
#include "cylindrical_worm_zk_zc_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
#include "cylindrical_worm_zc_za_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
#include "cylindrical_worm_zc_zi_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
#include "cylindrical_worm_zc_zn_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
#include "cylindrical_worm_zc_zk_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
#include "cylindrical_worm_zc_zc_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
#include "spherical_convex_convex_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
#include "spherical_convex_concave_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
#include "spherical_convex_spur_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
#include "spherical_concave_convex_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
#include "spherical_concave_concave_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
#include "spherical_concave_spur_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
#include "spherical_spur_convex_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
#include "spherical_spur_concave_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
#include "spherical_spur_spur_lanes.h"
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
#include "face_worm_lanes.h"
#endif

static const mw_lane_model mw_lane_models[] = {
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
    MW_LANE_MODEL(cylindrical_worm_za_za),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
    MW_LANE_MODEL(cylindrical_worm_za_zi),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
    MW_LANE_MODEL(cylindrical_worm_za_zn),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
    MW_LANE_MODEL(cylindrical_worm_za_zk),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
    MW_LANE_MODEL(cylindrical_worm_za_zc),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
    MW_LANE_MODEL(cylindrical_worm_zi_za),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
    MW_LANE_MODEL(cylindrical_worm_zi_zi),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
    MW_LANE_MODEL(cylindrical_worm_zi_zn),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
    MW_LANE_MODEL(cylindrical_worm_zi_zk),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
    MW_LANE_MODEL(cylindrical_worm_zi_zc),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
    MW_LANE_MODEL(cylindrical_worm_zn_za),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
    MW_LANE_MODEL(cylindrical_worm_zn_zi),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
    MW_LANE_MODEL(cylindrical_worm_zn_zn),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
    MW_LANE_MODEL(cylindrical_worm_zn_zk),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
    MW_LANE_MODEL(cylindrical_worm_zn_zc),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
    MW_LANE_MODEL(cylindrical_worm_zk_za),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
    MW_LANE_MODEL(cylindrical_worm_zk_zi),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
    MW_LANE_MODEL(cylindrical_worm_zk_zn),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
    MW_LANE_MODEL(cylindrical_worm_zk_zk),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
    MW_LANE_MODEL(cylindrical_worm_zk_zc),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
    MW_LANE_MODEL(cylindrical_worm_zc_za),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
    MW_LANE_MODEL(cylindrical_worm_zc_zi),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
    MW_LANE_MODEL(cylindrical_worm_zc_zn),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
    MW_LANE_MODEL(cylindrical_worm_zc_zk),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
    MW_LANE_MODEL(cylindrical_worm_zc_zc),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
    MW_LANE_MODEL(spherical_convex_convex),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
    MW_LANE_MODEL(spherical_convex_concave),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
    MW_LANE_MODEL(spherical_convex_spur),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
    MW_LANE_MODEL(spherical_concave_convex),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
    MW_LANE_MODEL(spherical_concave_concave),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
    MW_LANE_MODEL(spherical_concave_spur),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
    MW_LANE_MODEL(spherical_spur_convex),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
    MW_LANE_MODEL(spherical_spur_concave),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
    MW_LANE_MODEL(spherical_spur_spur),
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
    MW_LANE_MODEL(face_worm),
#endif
};
