0 BEGIN PGM 444 MM
1 ; Probes five points of a face with cycle 444; its log has them all.
2 ; A value that stands in its parameter before the start is kept.
3 FN 9: IF Q1 IS DEFINED GOTO LBL 11
4 Q1 = +50 ;Middle of the face in X
5 LBL 11
6 FN 9: IF Q2 IS DEFINED GOTO LBL 12
7 Q2 = +40 ;Middle of the face in Y
8 LBL 12
9 FN 9: IF Q3 IS DEFINED GOTO LBL 13
10 Q3 = +30 ;From the middle to the other points in X
11 LBL 13
12 FN 9: IF Q4 IS DEFINED GOTO LBL 14
13 Q4 = +24 ;The same in Y
14 LBL 14
15 FN 9: IF QS1 IS DEFINED GOTO LBL 15
16 QS1 = "0.03-0.03" ;Tolerance of a point
17 LBL 15
18 TOOL CALL 30 Z
19 * - The middle, then the four around it
20 Q11 = Q1
21 Q12 = Q2
22 CALL LBL 1
23 Q21 = Q164
24 Q11 = Q1 - Q3
25 Q12 = Q2 - Q4
26 CALL LBL 1
27 Q22 = Q164
28 Q11 = Q1 + Q3
29 CALL LBL 1
30 Q23 = Q164
31 Q12 = Q2 + Q4
32 CALL LBL 1
33 Q24 = Q164
34 Q11 = Q1 - Q3
35 CALL LBL 1
36 Q25 = Q164
37 M30
38 LBL 1
39 TCH PROBE 444 PROBING IN 3-D ~
    Q263=+Q11  ;1ST POINT IN X ~
    Q264=+Q12  ;1ST POINT IN Y ~
    Q294=+0    ;1ST POINT IN Z ~
    Q581=+0    ;NORMAL IN X ~
    Q582=+0    ;NORMAL IN Y ~
    Q583=+1    ;NORMAL IN Z ~
    Q320=+0    ;SET-UP CLEARANCE ~
    Q260=+30   ;CLEARANCE HEIGHT ~
    QS400=QS1  ;TOLERANCE ~
    Q309=+0    ;ERROR REACTION
40 LBL 0
41 END PGM 444 MM
