# The equations and their integration against independent derivations (included by CMakeLists.txt).
include(${PROJECT_SOURCE_DIR}/cmake/sundials.cmake)
find_package(SUNDIALS REQUIRED COMPONENTS arkode nvecserial)

equipoise_test(inertial_frame_test equivalence
  equivalence/inertial_frame_test.cpp equivalence/lagrangian.cpp equivalence/cases.cpp
  LIBRARIES SUNDIALS::arkode_shared SUNDIALS::nvecserial_shared)
equipoise_test(study_equations_test equivalence equivalence/study_equations_test.cpp)
equipoise_test(energy_balance_test equivalence
  equivalence/energy_balance_test.cpp equivalence/lagrangian.cpp equivalence/cases.cpp
  LIBRARIES SUNDIALS::arkode_shared SUNDIALS::nvecserial_shared)
equipoise_test(force_balance_test equivalence
  equivalence/force_balance_test.cpp equivalence/lagrangian.cpp
  LIBRARIES SUNDIALS::arkode_shared SUNDIALS::nvecserial_shared rapidcheck rapidcheck_gtest)
equipoise_test(hybrid_sundials_test equivalence
  equivalence/hybrid_sundials_test.cpp equivalence/lagrangian.cpp
  LIBRARIES SUNDIALS::arkode_shared SUNDIALS::nvecserial_shared)
equipoise_test(hybrid_energy_test equivalence equivalence/hybrid_energy_test.cpp)
equipoise_test(linearisation_test unit unit/linearisation_test.cpp unit/tangent_test.cpp)
equipoise_test(ball_rest_test unit unit/ball_rest_test.cpp)
equipoise_test(stability_test unit unit/stability_test.cpp)
equipoise_test(chart_test unit unit/chart_test.cpp)
equipoise_test(continuum_plane_test unit unit/continuum_plane_test.cpp)
equipoise_test(locked_chart_test unit unit/locked_chart_test.cpp)
equipoise_test(cycle_chart_test unit unit/cycle_chart_test.cpp)
equipoise_test(cycle_lines_test unit unit/cycle_lines_test.cpp unit/cycle_points_test.cpp)
equipoise_test(system_test unit unit/system_test.cpp unit/gravity_well_test.cpp)
equipoise_test(balanced_state_test unit unit/balanced_state_test.cpp)
equipoise_test(cancelling_test unit unit/cancelling_test.cpp)
equipoise_test(balanced_motion_test unit unit/balanced_motion_test.cpp)
equipoise_test(equation_constants_test unit unit/equation_constants_test.cpp)
equipoise_test(continuum_test unit unit/continuum_test.cpp)
equipoise_test(steady_state_test unit unit/catalogue_test.cpp unit/steady_state_test.cpp)
equipoise_test(convergence_test order order/convergence_test.cpp)
equipoise_test(coincident_balls_test equivalence equivalence/coincident_balls_test.cpp)
equipoise_test(speed_test unit unit/speed_test.cpp)
equipoise_test(interval_test unit unit/interval_test.cpp LIBRARIES Boost::headers)
equipoise_test(certificate_test unit unit/certificate_test.cpp)
equipoise_test(machine_certificate_test unit unit/machine_certificate_test.cpp)
equipoise_test(member_certificate_test unit unit/member_certificate_test.cpp)
equipoise_test(balanced_region_test unit unit/balanced_region_test.cpp)
equipoise_test(orbit_region_test equivalence equivalence/orbit_region_test.cpp WHOLE)
equipoise_test(torus_region_test equivalence equivalence/torus_region_test.cpp WHOLE)
equipoise_test(path_region_test equivalence equivalence/path_region_test.cpp WHOLE)
equipoise_test(search_work_test unit unit/search_work_test.cpp)
equipoise_test(symmetry_test unit unit/symmetry_test.cpp LIBRARIES rapidcheck rapidcheck_gtest)
equipoise_test(mean_rate_test unit unit/mean_rate_test.cpp)
equipoise_test(orbit_test equivalence equivalence/orbit_test.cpp)
equipoise_test(many_balls_test unit unit/many_balls_test.cpp)
equipoise_test(motion_test equivalence equivalence/motion_test.cpp)
equipoise_test(machine_motions_test equivalence equivalence/machine_motions_test.cpp)
equipoise_test(machine_regions_test equivalence equivalence/machine_regions_test.cpp)
equipoise_test(motor_branches_test equivalence equivalence/motor_branches_test.cpp)
equipoise_test(floquet_test equivalence equivalence/floquet_test.cpp)
equipoise_test(attractors_test equivalence equivalence/attractors_test.cpp)
equipoise_test(machine_test equivalence equivalence/machine_test.cpp equivalence/machine_reference.cpp)
equipoise_test(machine_limits_test equivalence equivalence/machine_limits_test.cpp)
equipoise_test(machine_labels_test equivalence equivalence/machine_labels_test.cpp
  LONG Passed.OfUndecidedStartsIsToldByWhereTheyWereLastSeen)
equipoise_test(event_motion_test equivalence equivalence/event_motion_test.cpp)
equipoise_test(tilt_test equivalence equivalence/tilt_equations_test.cpp equivalence/tilt_study_test.cpp
               equivalence/tilt_physical_test.cpp equivalence/tilt_explain_test.cpp)
equipoise_test(tilt_answers_test equivalence equivalence/tilt_answers_test.cpp equivalence/tilt_surveys_test.cpp
  LONG TiltFates.OfTwoHundredAreThoseOfFixedAxes TiltFates.AfterARampAndUnderAMotorAreThoseOfFixedAxes)
equipoise_test(tilt_families_test equivalence equivalence/tilt_families_test.cpp
  LONG TiltFamilies.StartsComeToWhatTheirRotorsComeTo TiltFamilies.SoDoStartsWhoseBallsAreHeld)
equipoise_test(tilt_certificate_test equivalence equivalence/tilt_certificate_test.cpp)
equipoise_test(tilt_motor_test equivalence equivalence/tilt_motor_test.cpp equivalence/tilt_bearings_test.cpp
  equivalence/tilt_observation_test.cpp)
equipoise_test(tilt_transients_test equivalence equivalence/tilt_transients_test.cpp equivalence/tilt_limits_test.cpp
  LONG TiltDesign.FindsBallsThatBalanceEachPlane)
