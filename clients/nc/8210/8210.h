0 BEGIN PGM 8210 MM
1 ; Probes the points of table 82101 in Z and sets the datum at the highest one.
2 ; A value that stands in its parameter before the start is kept.
3 FN 9: IF QL1 IS DEFINED GOTO LBL 11
4 QL1 = +5 ;Number of points
5 LBL 11
6 FN 9: IF QL2 IS DEFINED GOTO LBL 12
7 QL2 = +2 ;Z at which a measurement starts
8 LBL 12
9 FN 9: IF QL3 IS DEFINED GOTO LBL 13
10 QL3 = +0 ;Datum to be set in Z
11 LBL 13
12 FN 9: IF QL4 IS DEFINED GOTO LBL 14
13 QL4 = +30 ;Clearance above QL2
14 LBL 14
15 FN 9: IF QL5 IS DEFINED GOTO LBL 15
16 QL5 = +0 ;First row of the table
17 LBL 15
18 * - Prepare
19 QL6 = QL1 - 1 ;Repetitions
20 QL7 = QL2 + QL4 ;Clearance height
21 QL42 = -999999999 ;Lower than any point
22 FN 26: TABOPEN 82101.tab
23 TOOL CALL 30 Z
24 L Z+QL7 R0 FMAX
25 * - Every point
26 LBL 1
27 FN 28: TABREAD QL10 = QL5/"X,Y"
28 L X+QL10 Y+QL11 R0 FMAX
29 TCH PROBE 427 MEASURE COORDINATE ~
    Q263=+QL10 ;1ST POINT 1ST AXIS ~
    Q264=+QL11 ;1ST POINT 2ND AXIS ~
    Q261=+QL2  ;MEASURING HEIGHT ~
    Q320=+0    ;SET-UP CLEARANCE ~
    Q272=+3    ;MEASURING AXIS ~
    Q267=-1    ;TRAVERSE DIRECTION ~
    Q260=+QL7  ;CLEARANCE HEIGHT ~
    Q281=+0    ;MEASURING LOG ~
    Q288=+0    ;MAXIMUM ~
    Q289=+0    ;MINIMUM ~
    Q309=+0    ;STOP ON TOLERANCE ~
    Q330=+0    ;TOOL
30 FN 11: IF +Q160 GT +QL42 GOTO LBL 3
31 FN 9: IF +0 EQU +0 GOTO LBL 4
32 LBL 3
33 CALL LBL 2
34 LBL 4
35 QL5 = QL5 + 1
36 CALL LBL 1 REP QL6
37 * - Datum at the highest point
38 L X+QL40 Y+QL41 R0 FMAX
39 TCH PROBE 417 PRESET IN TS AXIS ~
    Q263=+QL40 ;1ST POINT 1ST AXIS ~
    Q264=+QL41 ;1ST POINT 2ND AXIS ~
    Q294=+QL42 ;1ST POINT 3RD AXIS ~
    Q320=+0    ;SET-UP CLEARANCE ~
    Q260=+QL7  ;CLEARANCE HEIGHT ~
    Q305=+1    ;ROW OF THE TABLE ~
    Q333=+QL3  ;NEW DATUM ~
    Q303=+1    ;INTO THE PRESET TABLE
40 CYCL DEF 247 PRESETTING ~
    Q339=+1    ;ROW OF THE TABLE
41 L M140 MB MAX
42 M30
43 * - Keep the point: a later one that is as high does not replace it
44 LBL 2
45 QL40 = QL10
46 QL41 = QL11
47 QL42 = Q160
48 LBL 0
49 END PGM 8210 MM
