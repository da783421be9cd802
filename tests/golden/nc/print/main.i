%PRINT G71 *
N10 Q1 = 25.0136 *
N20 Q2 = -3 *
N30 QS1 = "H7" *
N40 QS2 = "" *
N50 D16 P01 mask.a / SCREEN: *
N60 D16 P01 mask.a / out.txt *
N70 D16 P01 mask.a / out.txt *
N80 D16 P01 mask.a / SCLR: *
N90 D15 P01 Q1 P02 Q2 P03 "text" *
N99999999 %PRINT G71 *
