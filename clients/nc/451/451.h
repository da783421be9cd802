0 BEGIN PGM 451 MM
1 ; Checks the rotary axes A and C on a calibration sphere; if need be corrects the kinematics.
2 ; A value that stands in its parameter before the start is kept.
3 FN 9: IF QL1 IS DEFINED GOTO LBL 11
4 QL1 = +15 ;Radius of the calibration sphere
5 LBL 11
6 FN 9: IF QL2 IS DEFINED GOTO LBL 12
7 QL2 = +5 ;Positions of each axis
8 LBL 12
9 FN 9: IF QL3 IS DEFINED GOTO LBL 13
10 QL3 = +0.01 ;Largest standard deviation that is good
11 LBL 13
12 * - Over the sphere, in whose centre the active preset lies
13 TOOL CALL 30 Z
14 L X+0 Y+0 R0 FMAX
15 L Z+100 R0 FMAX
16 TCH PROBE 450 SAVE KINEMATICS ~
    Q410=+0 ;SAVE ~
    QS409="AS FOUND"
17 * - Check
18 QS1 = "AS FOUND"
19 QL4 = 0
20 CALL LBL 1
21 FN 12: IF +QL5 LT +QL3 GOTO LBL 3
22 * - Optimise, and check again
23 QL4 = 2
24 CALL LBL 1
25 QS1 = "AS CORRECTED"
26 QL4 = 0
27 CALL LBL 1
28 FN 12: IF +QL5 LT +QL3 GOTO LBL 4
29 TCH PROBE 450 SAVE KINEMATICS ~
    Q410=+1 ;RESTORE ~
    QS409="AS FOUND"
30 QS2 = "RESTORED: THE AXES SCATTER"
31 FN 9: IF +0 EQU +0 GOTO LBL 5
32 LBL 3
33 QS2 = "GOOD AS FOUND"
34 FN 9: IF +0 EQU +0 GOTO LBL 5
35 LBL 4
36 QS2 = "CORRECTED"
37 LBL 5
38 FN 16: F-PRINT 4512.a / SCREEN:
39 M30
40 * - Measure both axes: QL4 is the mode, QL5 the larger standard deviation
41 LBL 1
42 TCH PROBE 451 MEASURE KINEMATICS ~
    Q406=+QL4 ;MODE ~
    Q407=+QL1 ;SPHERE RADIUS ~
    Q320=+0   ;SET-UP CLEARANCE ~
    Q408=+100 ;RETRACTION HEIGHT ~
    Q253=+2000 ;F PRE-POSITIONING ~
    Q380=+0   ;REFERENCE ANGLE ~
    Q411=-90  ;START ANGLE A ~
    Q412=+90  ;END ANGLE A ~
    Q413=+0   ;INCID. ANGLE A ~
    Q414=+QL2 ;MEAS. POINTS A ~
    Q415=+0   ;START ANGLE B ~
    Q416=+0   ;END ANGLE B ~
    Q417=+0   ;INCID. ANGLE B ~
    Q418=+0   ;MEAS. POINTS B ~
    Q419=+60  ;START ANGLE C ~
    Q420=+300 ;END ANGLE C ~
    Q421=+0   ;INCID. ANGLE C ~
    Q422=+QL2 ;MEAS. POINTS C ~
    Q423=+4   ;NO. OF PROBE POINTS ~
    Q431=+0   ;PRESET ~
    Q432=+0   ;BACKLASH, ANG. RANGE
43 QL5 = Q141
44 FN 11: IF +Q141 GT +Q143 GOTO LBL 2
45 QL5 = Q143
46 LBL 2
47 FN 11: IF +QL4 GT +0 GOTO LBL 6
48 FN 16: F-PRINT 4511.a / SCREEN:
49 LBL 6
50 LBL 0
51 END PGM 451 MM
