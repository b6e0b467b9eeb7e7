/* Every drive for CasADi's external functions. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
MW_CASADI(cylindrical_worm_za_za, 35, 102, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
MW_CASADI(cylindrical_worm_za_zi, 35, 98, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
MW_CASADI(cylindrical_worm_za_zn, 35, 119, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
MW_CASADI(cylindrical_worm_za_zk, 35, 101, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
MW_CASADI(cylindrical_worm_za_zc, 35, 97, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
MW_CASADI(cylindrical_worm_zi_za, 35, 102, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
MW_CASADI(cylindrical_worm_zi_zi, 35, 97, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
MW_CASADI(cylindrical_worm_zi_zn, 35, 118, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
MW_CASADI(cylindrical_worm_zi_zk, 35, 101, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
MW_CASADI(cylindrical_worm_zi_zc, 35, 96, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
MW_CASADI(cylindrical_worm_zn_za, 35, 107, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
MW_CASADI(cylindrical_worm_zn_zi, 35, 102, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
MW_CASADI(cylindrical_worm_zn_zn, 35, 123, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
MW_CASADI(cylindrical_worm_zn_zk, 35, 106, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
MW_CASADI(cylindrical_worm_zn_zc, 35, 101, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
MW_CASADI(cylindrical_worm_zk_za, 35, 118, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
MW_CASADI(cylindrical_worm_zk_zi, 35, 114, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
MW_CASADI(cylindrical_worm_zk_zn, 35, 135, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
MW_CASADI(cylindrical_worm_zk_zk, 35, 114, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
MW_CASADI(cylindrical_worm_zk_zc, 35, 110, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
MW_CASADI(cylindrical_worm_zc_za, 35, 119, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
MW_CASADI(cylindrical_worm_zc_zi, 35, 114, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
MW_CASADI(cylindrical_worm_zc_zn, 35, 135, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
MW_CASADI(cylindrical_worm_zc_zk, 35, 115, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
MW_CASADI(cylindrical_worm_zc_zc, 35, 108, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_convex)
MW_CASADI(spherical_convex_convex, 25, 83, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_concave)
MW_CASADI(spherical_convex_concave, 25, 83, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_convex_spur)
MW_CASADI(spherical_convex_spur, 25, 83, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_convex)
MW_CASADI(spherical_concave_convex, 25, 82, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_concave)
MW_CASADI(spherical_concave_concave, 25, 82, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_concave_spur)
MW_CASADI(spherical_concave_spur, 25, 82, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_convex)
MW_CASADI(spherical_spur_convex, 25, 85, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_concave)
MW_CASADI(spherical_spur_concave, 25, 85, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_spherical_spur_spur)
MW_CASADI(spherical_spur_spur, 25, 80, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_face_worm)
MW_CASADI(face_worm, 53, 143, 6)
#endif
