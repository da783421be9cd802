0 BEGIN PGM 8255 MM
1 ; Measures a bore or a stud and says whether it keeps its tolerance class.
2 ; A value that stands in its parameter before the start is kept.
3 * - Fit
4 FN 9: IF Q1 IS DEFINED GOTO LBL 1
5 Q1 = +25 ;Nominal size
6 LBL 1
7 FN 9: IF QS1 IS DEFINED GOTO LBL 2
8 QS1 = "H7" ;Tolerance class, upper case for a bore
9 LBL 2
10 * - Place
11 FN 9: IF Q11 IS DEFINED GOTO LBL 3
12 Q11 = +50 ;Centre in X
13 LBL 3
14 FN 9: IF Q21 IS DEFINED GOTO LBL 4
15 Q21 = +40 ;Centre in Y
16 LBL 4
17 FN 9: IF Q31 IS DEFINED GOTO LBL 5
18 Q31 = -10 ;Measuring height: the centre of the ball
19 LBL 5
20 FN 9: IF Q41 IS DEFINED GOTO LBL 6
21 Q41 = +0 ;Angle of the first touch, three more follow at 90 degrees
22 LBL 6
23 FN 9: IF Q51 IS DEFINED GOTO LBL 7
24 Q51 = +0 ;Clearance to the wall beside SET_UP
25 LBL 7
26 CALL PGM 82551
27 STOP
28 END PGM 8255 MM
