BEGIN TOOL .T MM
; a comment
T       NAME      L         R         TP_NO
0
30      PROBE     +120      +2        1
[END]
