/* Every drive for CasADi's external functions. Generated; do not edit.  SPDX-License-Identifier: MIT-0 */
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_za)
MW_CASADI(cylindrical_worm_za_za, 34, 92, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zi)
MW_CASADI(cylindrical_worm_za_zi, 34, 87, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zn)
MW_CASADI(cylindrical_worm_za_zn, 34, 102, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zk)
MW_CASADI(cylindrical_worm_za_zk, 34, 95, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_za_zc)
MW_CASADI(cylindrical_worm_za_zc, 34, 91, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_za)
MW_CASADI(cylindrical_worm_zi_za, 34, 92, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zi)
MW_CASADI(cylindrical_worm_zi_zi, 34, 86, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zn)
MW_CASADI(cylindrical_worm_zi_zn, 34, 101, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zk)
MW_CASADI(cylindrical_worm_zi_zk, 34, 95, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zi_zc)
MW_CASADI(cylindrical_worm_zi_zc, 34, 90, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_za)
MW_CASADI(cylindrical_worm_zn_za, 34, 97, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zi)
MW_CASADI(cylindrical_worm_zn_zi, 34, 91, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zn)
MW_CASADI(cylindrical_worm_zn_zn, 34, 106, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zk)
MW_CASADI(cylindrical_worm_zn_zk, 34, 100, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zn_zc)
MW_CASADI(cylindrical_worm_zn_zc, 34, 95, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_za)
MW_CASADI(cylindrical_worm_zk_za, 34, 108, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zi)
MW_CASADI(cylindrical_worm_zk_zi, 34, 103, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zn)
MW_CASADI(cylindrical_worm_zk_zn, 34, 118, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zk)
MW_CASADI(cylindrical_worm_zk_zk, 34, 108, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zk_zc)
MW_CASADI(cylindrical_worm_zk_zc, 34, 104, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_za)
MW_CASADI(cylindrical_worm_zc_za, 34, 109, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zi)
MW_CASADI(cylindrical_worm_zc_zi, 34, 103, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zn)
MW_CASADI(cylindrical_worm_zc_zn, 34, 118, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zk)
MW_CASADI(cylindrical_worm_zc_zk, 34, 109, 5)
#endif
#if !defined(MW_DRIVES) || defined(MW_DRIVE_cylindrical_worm_zc_zc)
MW_CASADI(cylindrical_worm_zc_zc, 34, 102, 5)
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
